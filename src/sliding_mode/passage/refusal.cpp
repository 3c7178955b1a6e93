#include "sliding_mode/passage/refusal.h"

#include <array>

#include "sliding_mode/words.h"

namespace gapscope::internal::sliding_mode {
namespace {

struct Meaning {
  PassageTest test;
  const char* text;
  Remark (*advice)();
};

/// In the order of Refusal.
constexpr std::array kMeanings{
    Meaning{PassageTest::kTurn, "", words::more_periods},
    Meaning{PassageTest::kImpact, "not more abrupt than the motion before it", words::no_impact_stands_out},
    Meaning{PassageTest::kTurn, "the load met the far flank before x1 turned", words::load_coasts_through},
    Meaning{PassageTest::kTurn, "too few encoder quanta between reversal and impact",
            words::passages_few_quanta_wide},
    Meaning{PassageTest::kImpact, "the contact held under pull and tore: the load was dragged along",
            words::contact_tears},
    Meaning{PassageTest::kImpact, "the load drove the motor at the impact", words::load_hits_motor},
    Meaning{PassageTest::kImpact, "no kink of x1 at the impact", words::few_samples_around_impacts},
    Meaning{PassageTest::kRelease, "neither a rest nor a separation is seen before the impact",
            words::release_not_located},
    Meaning{PassageTest::kLoad, "the load was moving between t1 and t2", words::load_moves},
    Meaning{PassageTest::kLoad, "the flank that was left is hit again", words::load_moves},
    Meaning{PassageTest::kLoad, "the impact before it threw motor and load apart", words::load_moves},
    Meaning{PassageTest::kLoad, "the motor may have come to rest within the gap", words::rests_alone},
    Meaning{PassageTest::kLoad, "a force drove the load through the gap, too", words::load_pushed},
};
static_assert(kMeanings.size() == static_cast<std::size_t>(Refusal::kPushed) + 1);

const Meaning& meaning(Refusal refusal) { return kMeanings[static_cast<std::size_t>(refusal)]; }

}  // namespace

PassageTest test_of(Refusal refusal) { return meaning(refusal).test; }
const char* refusal_text(Refusal refusal) { return meaning(refusal).text; }
Remark advice(Refusal refusal) { return meaning(refusal).advice(); }

bool speaks_of_moving_load(Refusal refusal) {
  return refusal == Refusal::kTorn || (refusal != Refusal::kNone && test_of(refusal) == PassageTest::kLoad);
}

bool says_nothing(Refusal refusal) {
  return refusal == Refusal::kThrownOff || refusal == Refusal::kContrast || refusal == Refusal::kSameFlank;
}

}  // namespace gapscope::internal::sliding_mode
