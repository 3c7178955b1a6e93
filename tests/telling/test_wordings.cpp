// Every sentence that a card can say, with made-up facts: told/test_wordings.txt is to be read aloud.
#include <gmock/gmock.h>

#include <map>
#include <optional>
#include <set>

#include "gapscope/telling/statement.h"
#include "support/told.h"

namespace gapscope {
namespace {

/// What stands for a fact where a wording names it.
Fact example_of(const std::string& key) {
  static const std::map<std::string, Fact> facts = [] {
    std::map<std::string, Fact> all;
    const auto put = [&](Fact fact) { all.emplace(fact.key, std::move(fact)); };
    for (const char* length : {"least", "play", "lost", "small", "large", "limit", "scatter", "off", "given",
                               "travel", "whole", "held", "miss", "all", "all_mended", "mended", "rms"})
      put(number(length, 0.0187, "rad"));
    put(number("gap", 0.0187, "rad", {0.0185, 0.0189}));
    put(number("other", 0.0191, "rad", {0.0188, 0.0194}));
    put(number("read", 0.0191, "rad", {0.0188, 0.0194}));
    for (const char* torque : {"missing", "before", "after"}) put(number(torque, 0.0153, "N m"));
    for (const char* share : {"share", "apart", "share_after", "fall", "low", "high", "p", "drift"})
      put(per_cent(share, 7.2));
    for (const char* count : {"times", "floors", "bound", "ratio", "to_small", "to_large", "band", "turns",
                              "duration", "factor", "more", "rows"})
      put(ratio(count, 3.0));
    put(names("causes", std::vector<ToldName>{{"motor Coulomb friction"},
                                              {"inverse Stribeck friction", "lower at low speed"}}));
    put(names("open", std::vector<ToldName>{{"input delay", "it may as well be actuator lag"}}));
    put(names("added", std::vector<ToldName>{{"motor Coulomb friction", "20.5 N"},
                                             {"cogging torque", "every 2.5 mm; 2 N"}}));
    put(names("left", std::vector<ToldName>{{"4 N with motor Coulomb friction", "20.5 N"},
                                            {"2 N with cogging torque", "2 N"}}));
    put(names("group", std::vector<std::string>{"cogging torque", "load unbalance"}));
    put(names("rivals", std::vector<std::string>{"input delay", "actuator lag"}));
    put(names("by", std::vector<std::string>{"6 σ if input delay is the cause", "9 σ if actuator lag is"}));
    for (const auto& [name, text] : std::map<std::string, std::string>{
             {"why", "The model misses 31 % of what the torque does to the motion."},
             {"reason", "no impact stands out of the motion"},
             {"rejected", "the fitted model is rejected"},
             {"how", "`gapscope detect CONFIG`"},
             {"per", "rad/s²"},
             {"doubt", "x1 is held over two rows"},
             {"floor", "the encoder's noise"},
             {"refitted", "refitted"},
             {"has", "viscous friction"},
             {"source", "input applies"},
             {"input", "212 mN·m"},
             {"measure", "free run restarted every 0.5 s"},
             {"judged", "free run"},
             {"error", "free-run error"},
             {"parts", "recordings"},
             {"where", "is periodic in the motor angle with 24 cycles per turn"},
             {"fit", "97.5 %"},
             {"x", "x1"},
             {"rival", "Stribeck friction"},
             {"suspect", "cogging torque"},
             {"nearest", "cogging torque"},
             {"first", "cogging torque"},
             {"row", "it has no cogging torque, where the drive has 2 N"},
             {"variable", "speed"},
             {"law", "friction_curve"},
             {"brief", "motor inertia 0.114 → 0.154 kg m² and 3 more"},
             {"changes", "motor inertia 0.114 → 0.154 kg m² (95 %: 0.153 to 0.155)"},
             {"way", "smaller"},
             {"estimate", "{estimate: true}"},
             {"auto", "{bound: auto}"},
             {"tolerance", "{torque_percent: 1}"},
             {"motion", "other speeds, other loads"},
             {"swap", "swap `file` and `held_out`"},
             {"addition", "cogging torque"},
             {"format", "mjcf"},
             {"what", "it"},
             {"lost", "cogging torque"},
             {"truth", "input delay"},
             {"advice", "record anew with x1 of every row"}})
      all.insert_or_assign(name, word(name, text));
    return all;
  }();
  const auto found = facts.find(key);
  return found == facts.end() ? word(key, "<" + key + ">") : found->second;
}

/// Where a key stands for something else than in most wordings.
std::optional<Fact> example_of(const std::string& code, const std::string& key) {
  struct Other {
    const char* codes;  ///< as they begin
    Fact fact;
  };
  static const Other others[] = {
      {"error.noise", number("floor", 0.018, "rad")},
      {"error.repeats", number("floor", 0.018, "rad")},
      {"error.floor", number("floor", 0.004, "N m")},
      {"helps.left.records", number("floor", 0.004, "N m")},
      {"helps.left.floor", number("floor", 0.004, "N m")},
      {"helps.left", number("left", 0.02, "N m")},
      {"next.do_not_rely", per_cent("left", 7.2)},
      {"lost_motion", number("lost", 0.0338, "rad", {0.033, 0.0346})},
      {"error.as_configured", word("judged", "simulated")},
      {"error.as_configured", number("before", 0.017, "rad")},
      {"error.as_configured", number("after", 0.0071, "rad")},
      {"error.free_run", number("before", 0.33, "rad")},
      {"error.free_run", number("after", 0.0154, "rad")},
      {"error.closed_loop", number("before", 0.0152, "rad")},
      {"error.closed_loop", number("after", 4.35e-4, "rad")},
      {"error.fitted_loop", number("mae", 0.0291, "rad")},
      {"error.fitted_loop", number("most", 0.0881, "rad")},
      {"error.fitted_loop", ratio("count", 30.0)},
      {"error.fitted_loop", word("worst", "steps_3.csv")},
      {"firmware.rate", number("value", 500.0, "Hz", {499.96, 500.04})},
      {"firmware.speed", number("value", 3.9, "rad/s", {3.89, 3.91})},
      {"firmware.acceleration", number("value", 21.5, "rad/s^2", {21.4, 21.6})},
      {"firmware.filter", number("value", 0.0664, "s", {0.066, 0.0669})},
      {"firmware.goal_late", number("value", 0.0102, "s", {0.0094, 0.011})},
      {"firmware.late", number("value", 0.0021, "s", {0.0018, 0.0024})},
      {"firmware.ends", number("value", 1.0, "unit of u", {0.997, 1.004})},
      {"firmware.falls", number("value", 0.31, "rad", {0.3, 0.32})},
      {"cause.loop.drive",
       names("effects", std::vector<ToldName>{{"motor Coulomb friction", "89 mN·m, 95 %: 84 to 95 mN·m"},
                                              {"load-dependent friction", "28 %, 95 %: 24 to 32 %"}})},
      {"helps.loop", number("before", 0.0292, "rad")},
      {"helps.loop", number("after", 0.0121, "rad")},
      {"helps.motion", number("before", 0.138, "rad")},
      {"helps.motion", number("after", 2e-3, "rad")},
      {"helps.no_nearer", number("before", 1.28e-3, "rad")},
      {"helps.no_nearer", number("after", 1.42e-3, "rad")},
      {"next.simulate", number("before", 0.147, "rad")},
      {"next.simulate", number("after", 1.45, "rad")},
      {"simulator.mended", number("error", 0.269, "rad")},
      {"simulator.not_mended", number("error", 0.269, "rad")},
      {"helps.simulator", number("error", 0.269, "rad")},
      {"simulator.differs",
       names("rows", std::vector<std::string>{"it has no cogging torque, where the drive has 2 N",
                                              "its mass is 2 kg where the drive's is 3 kg"})},
      {"next.mend_simulator", names("rows", std::vector<std::string>{"cogging torque", "motor inertia"})},
      {"tolerance.torque", per_cent("limit", 5.0)},
      {"gap.not_followed", ratio("least", 10.0)},
      {"next.estimate", names("held", std::vector<std::string>{"load_damping", "motor_damping"})},
      {"next.estimate_gap", number("held", 0.08, "rad")},
      {"next.experiment.record", word("input", "a sine of 0.5 units of u at 0.3 Hz")},
      {"next.go_on", word("first", "Record both directions, too: without them causes stay open.")}};
  std::optional<Fact> found;
  for (const Other& other : others)
    if (code.starts_with(other.codes) && other.fact.key == key) found = other.fact;
  return found;
}

std::string with_examples(const Wording& w, const char* wording) {
  Statement s{w.code};
  const std::string text = wording;
  std::set<std::string> seen;
  for (std::size_t at = text.find('{'); at != text.npos; at = text.find('{', at + 1)) {
    const std::string key = text.substr(at + 1, text.find_first_of("}#:?", at) - at - 1);
    if (key != "torque" && seen.insert(key).second)
      s.facts.push_back(example_of(w.code, key).value_or(example_of(key)));
  }
  return in_words(s, wording, Coordinates());
}

TEST(Wordings, AreAllReadAloud) {
  for (const Wording& w : wordings()) {
    const std::string code = w.code;
    if (*w.brief != '\0') {
      EXPECT_TOLD(code + ": " + with_examples(w, w.brief));
    }
    if (w.whole != nullptr) {
      EXPECT_TOLD(code + " in full: " + with_examples(w, w.whole));
    }
  }
}

TEST(Wordings, HaveACodeEach) {
  std::set<std::string> codes;
  for (const Wording& w : wordings()) EXPECT_TRUE(codes.insert(w.code).second) << w.code;
}

TEST(Wordings, LeaveOutWhatIsNotThere) {
  const Statement bare{
      "error.free_run",
      {number("before", 0.33, "rad"), number("after", kNaN, "rad"), number("travel", 0.247, "rad")}};
  EXPECT_TOLD(in_words({bare}, Detail::kBrief, Coordinates::kTranslation));
  EXPECT_THROW(in_words({{"no.such.code"}}, Detail::kBrief, Coordinates()), std::logic_error);
}

}  // namespace
}  // namespace gapscope
