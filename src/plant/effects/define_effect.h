#pragma once

#include "gapscope/plant/effect.h"

namespace gapscope::internal::plant {

/// Collects whatever laws the class E has into hooks for the scalar T.
template <class E, class T>
constexpr EffectHooks<T> hooks_of() {
  EffectHooks<T> h;
  if constexpr (requires { &E::template shape<T>; }) h.shape = &E::template shape<T>;
  if constexpr (requires { &E::template command<T>; }) h.command = &E::template command<T>;
  if constexpr (requires { &E::template delay<T>; }) h.delay = &E::template delay<T>;
  if constexpr (requires { &E::template torque<T>; }) h.torque = &E::template torque<T>;
  if constexpr (requires { &E::template decay<T>; }) h.decay = &E::template decay<T>;
  if constexpr (requires { &E::template half_gap<T>; }) h.half_gap = &E::template half_gap<T>;
  if constexpr (requires { &E::template load_inertia<T>; }) h.load_inertia = &E::template load_inertia<T>;
  if constexpr (requires { &E::template sense<T>; }) h.sense = &E::template sense<T>;
  if constexpr (requires { &E::template remember<T>; }) h.remember = &E::template remember<T>;
  if constexpr (requires { &E::template advance<T>; }) h.advance = &E::template advance<T>;
  if constexpr (requires { &E::template rate<T>; }) h.rate = &E::template rate<T>;
  if constexpr (requires { &E::template quantum<T>; }) h.quantum = &E::template quantum<T>;
  return h;
}

template <class E, class T>
inline constexpr EffectHooks<T> kHooks = hooks_of<E, T>();

}  // namespace gapscope::internal::plant

/// Defines the catalogue row `identifier` from a class with `parameters`, `look_alikes`, `side`, `law` and
/// its hooks.
#define GAPSCOPE_DEFINE_EFFECT(identifier, Class)                 \
  namespace gapscope::internal::plant {                           \
  extern const EffectEntry effect_##identifier;                   \
  const EffectEntry effect_##identifier{#identifier,              \
                                        Class::side,              \
                                        Class::law,               \
                                        Class::parameters,        \
                                        Class::look_alikes,       \
                                        &kHooks<Class, double>,   \
                                        &kHooks<Class, Jet<4>>,   \
                                        &kHooks<Class, Jet<8>>,   \
                                        &kHooks<Class, Jet<12>>}; \
  }
