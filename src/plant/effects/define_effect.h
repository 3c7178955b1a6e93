#pragma once

#include <array>
#include <span>

#include "gapscope/base/statistics.h"
#include "gapscope/plant/effect_hooks.h"

namespace gapscope::internal::plant {

/// Starts at all four quarters of a phase, for each amplitude.
template <std::size_t N>
constexpr std::array<EffectStart, 4 * N> quarters(const double (&amplitudes)[N]) {
  std::array<EffectStart, 4 * N> starts{};
  std::size_t i = 0;
  for (const double a : amplitudes)
    for (const double quarter : {0.0, 0.5, 1.0, 1.5}) starts[i++] = {a, quarter * kPi};
  return starts;
}

/// Collects whatever laws the class E has into hooks for the scalar T.
template <class E, class T>
constexpr EffectHooks<T> collected_hooks() {
  EffectHooks<T> h;
  if constexpr (requires { &E::template shape<T>; }) h.shape = &E::template shape<T>;
  if constexpr (requires { &E::template command<T>; }) h.command = &E::template command<T>;
  if constexpr (requires { &E::template delay<T>; }) h.delay = &E::template delay<T>;
  if constexpr (requires { &E::template torque<T>; }) h.torque = &E::template torque<T>;
  if constexpr (requires { &E::template decay<T>; }) h.decay = &E::template decay<T>;
  if constexpr (requires { &E::template contact<T>; }) h.contact = &E::template contact<T>;
  if constexpr (requires { &E::template half_gap<T>; }) h.half_gap = &E::template half_gap<T>;
  if constexpr (requires { &E::template load_inertia<T>; }) h.load_inertia = &E::template load_inertia<T>;
  if constexpr (requires { &E::template sense<T>; }) h.sense = &E::template sense<T>;
  if constexpr (requires { &E::template remember<T>; }) h.remember = &E::template remember<T>;
  if constexpr (requires { &E::template advance<T>; }) h.advance = &E::template advance<T>;
  if constexpr (requires { &E::template rate<T>; }) h.rate = &E::template rate<T>;
  if constexpr (requires { &E::template quantum<T>; }) h.quantum = &E::template quantum<T>;
  return h;
}

template <class E>
inline constexpr EffectLaws kLaws = {{collected_hooks<E, double>(), collected_hooks<E, Jet<4>>(),
                                      collected_hooks<E, Jet<8>>(), collected_hooks<E, Jet<12>>()}};

/// The row of the class E; what it does not say stays at what most effects have.
template <class E>
constexpr EffectEntry entry_of(const char* name) {
  EffectEntry e{name,
                E::side,
                E::law,
                E::parameters,
                E::look_alikes,
                E::follows,
                {},
                EffectNeeds::kNothing,
                -1,
                nullptr,
                StartSearch::kListed,
                {},
                &kLaws<E>};
  if constexpr (requires { E::acts_in; }) e.acts_in = E::acts_in;
  if constexpr (requires { E::needs; }) e.needs = E::needs;
  if constexpr (requires { E::stands_for; }) e.stands_for = E::stands_for;
  if constexpr (requires { E::contains; }) e.contains = E::contains;
  if constexpr (requires { E::start_search; }) e.start_search = E::start_search;
  if constexpr (requires { E::starts; }) e.starts = E::starts;
  if constexpr (requires { E::turns_with; }) e.turns_with = E::turns_with;
  return e;
}

}  // namespace gapscope::internal::plant

/// Defines the catalogue row `identifier` from a class with `side`, `law`, `parameters`, `look_alikes`,
/// `follows`, whatever else it says of itself (EffectEntry), and its hooks.
#define GAPSCOPE_DEFINE_EFFECT(identifier, Class)                                 \
  namespace gapscope::internal::plant {                                           \
  extern const EffectEntry effect_##identifier;                                   \
  constinit const EffectEntry effect_##identifier = entry_of<Class>(#identifier); \
  }
