#include "sliding_mode/passage/refusal.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

struct Meaning {
  PassageTest test;
  const char* text;
  Remark (*advice)();
  const char* measure = "";  ///< of what was seen, and what is asked
};

/// In the order of Refusal.
constexpr std::array kMeanings{
    Meaning{PassageTest::kTurn, "", words::more_periods},
    Meaning{PassageTest::kImpact, "not more abrupt than the motion before it", words::no_impact_stands_out,
            " ({:.2g} times, {:.2g} asked)"},
    Meaning{PassageTest::kTurn, "the load met the far flank before x1 turned", words::load_coasts_through},
    Meaning{PassageTest::kTurn, "too few encoder quanta between reversal and impact",
            words::passages_few_quanta_wide,
            " ({:.2g} of the way that noise and counts feign, {:.0f} asked)"},
    Meaning{PassageTest::kImpact, "the contact held under pull and tore: the load was dragged along",
            words::contact_tears},
    Meaning{PassageTest::kImpact, "the load drove the motor at the impact", words::load_hits_motor},
    Meaning{PassageTest::kImpact, "no kink of x1 at the impact", words::few_samples_around_impacts},
    Meaning{PassageTest::kRelease, "neither a rest nor a separation is seen before the impact",
            words::release_not_located},
    Meaning{PassageTest::kLoad, "the load was moving between t1 and t2", words::load_moves,
            " ({:.2g} of the gap is open by that, at most {:.2g} asked)"},
    Meaning{PassageTest::kLoad, "the flank that was left is hit again", words::load_moves},
    Meaning{PassageTest::kLoad, "the impact before it threw motor and load apart", words::load_moves,
            " ({:.2g} of the flight lies between, {:.2g} asked)"},
    Meaning{PassageTest::kLoad, "the motor may have come to rest within the gap", words::rests_alone},
    Meaning{PassageTest::kLoad, "a force drove the load through the gap, too", words::load_pushed,
            " (by {:.2g} of the gap, at most {:.2g} asked)"},
};
static_assert(kMeanings.size() == static_cast<std::size_t>(Refusal::kPushed) + 1);

const Meaning& meaning(Refusal refusal) { return kMeanings[static_cast<std::size_t>(refusal)]; }

}  // namespace

PassageTest test_of(Refusal refusal) { return meaning(refusal).test; }
std::string refusal_text(Refusal refusal, double seen, double limit) {
  const Meaning& m = meaning(refusal);
  return std::isnan(seen) ? m.text : m.text + fmt::format(fmt::runtime(m.measure), seen, limit);
}
Remark advice(Refusal refusal) { return meaning(refusal).advice(); }

bool speaks_of_moving_load(Refusal refusal) {
  return refusal == Refusal::kTorn || (refusal != Refusal::kNone && test_of(refusal) == PassageTest::kLoad);
}

bool says_nothing(Refusal refusal) {
  return refusal == Refusal::kThrownOff || refusal == Refusal::kContrast || refusal == Refusal::kSameFlank;
}

}  // namespace gapscope::internal::sliding_mode
