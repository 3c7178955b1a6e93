#include "report/glossary.h"

#include <vector>

#include "report/markdown.h"

namespace gapscope::internal::report {
namespace {

struct Word {
  const char* occurs;  ///< what is looked for in the text
  const char* word;
  const char* meaning;
};

/// In the order in which a reader meets them.
constexpr Word kWords[] = {
    {"fitted model", "fitted model",
     "the model of the configuration, its free numbers fitted to the recording"},
    {"x1", "u, x1",
     "the recorded columns: input of the motor (in the unit that was declared), and its position"},
    {"set aside", "set aside", "of a passage: seen, but not used for the estimate"},
    {"passage", "passage", "the motor crosses the gap, from contact lost (t1) to contact regained (t2)"},
    {"e_x", "e_x, L",
     "position error of the super-twisting differentiator, and the bound on the acceleration that it is "
     "given: e_x rests near zero while the motion stays below L"},
    {"encoder floor", "encoder floor",
     "what the encoder leaves of the error of a perfect model: its quantum over √12, or its noise where that is more"},
    {"repeatability floor", "repeatability floor",
     "how far the drive repeats its own motion from one period of the input to the next (rms difference over "
     "√2): an error below it does not show in a recording like this"},
    {"| identifiable |", "identifiable",
     "the recordings determine this number; if not, its value is one of many"},
    {"Free run", "free run",
     "the fitted model under the recorded input from its initial state on, never corrected by the recording"},
    {"a fit of", "fit",
     "100·(1 − |x1 − model| / |x1 − mean|) of the free run (NRMSE), worst recording: 100 % is perfect, 0 no "
     "better than its mean"},
    {"prediction error", "prediction error",
     "what an observer, the model corrected by the encoder at every sample, still misses at the next one"},
    {"nominal model", "nominal model", "the model of the configuration, its estimated parameters fitted"},
    {"held-out", "held-out", "recorded, but seen by no fit (but for where a warning says so)"},
    {"free run restarted", "free run restarted",
     "the model runs alone for that long, then starts again from the state of an observer"},
    {"prediction at", "prediction at ... Hz",
     "what an observer with its poles there still misses at the next sample: slow drifts show at the lower, "
     "ripple at the higher one"},
    {"issing torque", "missing torque",
     "rms of the torque that the input applies and the model does not account for, on held-out data and "
     "below the frequency of the error budget (with no budget: the correcting torque): the torque on the card"},
    {"issing force", "missing force",
     "rms of the force that the input applies and the model does not account for, on held-out data and below "
     "the frequency of the error budget (with no budget: the correcting force): the force on the card"},
    {"orrecting torque", "correcting torque",
     "the torque that would correct an observer at 30 Hz, sample by sample: noise of the encoder is in it. "
     "Figures over time, position, speed and input show what of it is slow"},
    {"orrecting force", "correcting force",
     "the force that would correct an observer at 30 Hz, sample by sample: noise of the encoder is in it. "
     "Figures over time, position, speed and input show what of it is slow"},
    {"error removed", "error removed",
     "(error before − after) / (before − floor), as median over windows: 1 reaches the floor, below 0 it is worse"},
    {"explained share", "explained share",
     "share of the way to the floor in the mean logarithm of prediction and free-run error, which a few "
     "large errors cannot decide: 1 at the floor, below 0 worse than without; candidates are ranked by it, "
     "but a simple effect goes before one that contains it"},
    {"| windows better |", "windows better",
     "share of the held-out windows (half a second each, or less) above the floor in which its free run errs less"},
    {"not in the catalogue", "not in the catalogue",
     "none of the effects that `gapscope effects` lists is what is missing"},
    {"not separable from", "not separable from",
     "other effects that explain these recordings nearly as well: one of them may be the cause instead"},
    {"made superfluous", "made superfluous",
     "an earlier effect that was taken out again, because without it the model is hardly worse now"},
    {"over neighbouring periods", "over neighbouring periods",
     "its share of the squared torque or force, times what periods beside it have"},
    {"holds there", "holds there", "improves more held-out windows than chance would let, at 1 %"},
    {"biased by", "bias", "what the nominal model reads too high or too low to make up for what it lacks"},
    {"in engagement", "in engagement", "the contact is closed on either side: motor and load move as one"},
    {"stablished", "established",
     "of a cause: no other effect, and no free curve over another quantity, explains these recordings nearly "
     "as well; its amount is more than none, and the simulated motion comes nearer. *Established with* "
     "another: as long as that one, whose own cause is open, is in the model"},
    {"ikely, ", "likely",
     "of a cause: the balance of torque or force says so, and the simulated motion cannot decide"},
    {"(cause open)", "cause open",
     "not established: it accounts for its share of the error, but another cause may do so as well; the "
     "interval of its amount holds if it is there"},
    {" σ |", "σ", "rms of the encoder's noise"},
    {"if spread evenly", "if spread evenly",
     "the share that an error alike at all times would have: that of the time spent there"}};

}  // namespace

std::string glossary_section(const std::string& text) {
  std::vector<std::string> lines;
  for (const Word& w : kWords)
    if (text.find(w.occurs) != std::string::npos)
      lines.push_back("*" + std::string(w.word) + "*: " + w.meaning + ".");
  return bullet_section("Words", lines);
}

}  // namespace gapscope::internal::report
