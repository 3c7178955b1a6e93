#include "inspection/column_words.h"

#include <algorithm>
#include <cctype>
#include <span>
#include <utility>

#include "base/text.h"
#include "recording/column_name.h"

namespace gapscope::internal::inspection {
namespace {

/// A word and how well it says what the column is.
struct Word {
  const char* text;
  int says;
};

/// Names as a whole, then words in them; English, German and French, as logs of robots, drives and PLCs have
/// them.
constexpr Word kTimes[] = {{"t", 9},        {"time", 8},    {"timestamp", 8}, {"zeit", 8},    {"stamp", 6},
                           {"datetime", 7}, {"clock", 5},   {"date", 3},      {"elapsed", 6}, {"temps", 6},
                           {"epoch", 5},    {"seconds", 5}, {"xvalue", 8},    {"millis", 5},  {"ts", 6},
                           {"micros", 5},   {"nanos", 5},   {"ms", 4},        {"us", 4},      {"ns", 4}};
constexpr Word kInputs[] = {{"u", 9},          {"torque", 8},  {"tau", 8},   {"effort", 8},  {"moment", 7},
                            {"drehmoment", 8}, {"force", 8},   {"kraft", 8}, {"current", 7}, {"iq", 7},
                            {"strom", 7},      {"courant", 7}, {"amps", 6},  {"curr", 6},    {"couple", 7},
                            {"i", 5},          {"duty", 6},    {"pwm", 6},   {"voltage", 5}, {"volts", 5},
                            {"spannung", 5},   {"load", 4},    {"ctrl", 3},  {"control", 3}, {"action", 3}};
constexpr Word kPositions[] = {{"x1", 9},
                               {"position", 8},
                               {"pos", 8},
                               {"angle", 8},
                               {"theta", 8},
                               {"winkel", 8},
                               {"encoder", 6},
                               {"enc", 6},
                               {"q", 6},
                               {"x", 5},
                               {"phi", 6},
                               {"weg", 6},
                               {"lage", 6},
                               {"qpos", 7},
                               {"actpos", 8},
                               {"travel", 5},
                               {"scale", 4},
                               {"th", 4},
                               {"displacement", 6},
                               {"counts", 4},
                               {"observationstate", 6}};
constexpr Word kSpeeds[] = {{"speed", 8},
                            {"velocity", 8},
                            {"vel", 8},
                            {"omega", 7},
                            {"rpm", 6},
                            {"w", 5},
                            {"v", 4},
                            {"qd", 6},
                            {"dq", 6},
                            {"qvel", 7},
                            {"drehzahl", 8},
                            {"vitesse", 8},
                            {"geschwindigkeit", 8}};
constexpr Word kTargets[] = {{"target", 8},  {"goal", 8},      {"setpoint", 8}, {"desired", 7},
                             {"des", 6},     {"cmd", 7},       {"command", 7},  {"commanded", 7},
                             {"ref", 6},     {"reference", 6}, {"soll", 7},     {"demand", 6},
                             {"sollwert", 7}};
/// A column of one of these is none of them.
constexpr const char* kOthers[] = {"error", "err",     "limit",        "max",    "min",   "supply",
                                   "bus",   "battery", "temp",         "std",    "count", "id",
                                   "flag",  "acc",     "acceleration", "status", "vin"};

std::span<const Word> words_for(ColumnRole role) {
  switch (role) {
    case ColumnRole::kTime:
      return kTimes;
    case ColumnRole::kInput:
      return kInputs;
    case ColumnRole::kPosition:
      return kPositions;
    case ColumnRole::kSpeed:
      return kSpeeds;
    case ColumnRole::kTarget:
      return kTargets;
  }
  return {};
}

/// The name without a unit in brackets at its end, and without the place in a list.
std::string_view stem_of(std::string_view name) {
  const bool bracketed = name.ends_with(']') || name.ends_with(')');
  const std::size_t bracket = bracketed ? name.find_last_of("[(") : name.npos;
  return bracket == name.npos || bracket == 0 ? name : name.substr(0, bracket);
}

/// What stands last in a path, "q" of "state.q".
std::string_view end_of_path(std::string_view stem) {
  const std::size_t at = stem.find_last_of("./");
  return at == stem.npos ? stem : stem.substr(at + 1);
}

std::string small_of(std::string_view text) {
  std::string small;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      small += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return small;
}

bool is_word(const std::string& word, std::string_view known) {
  return word == known || (word.size() > 4 && word.back() == 's' &&
                           std::string_view(word).substr(0, word.size() - 1) == known);
}

/// The best of the words in a name; a name that is the word alone says it best.
int best_of(std::string_view stem, std::span<const Word> known) {
  const std::string whole = small_of(stem), last = small_of(end_of_path(stem));
  const std::vector<std::string> words = words_of_name(stem);
  int best = 0;
  for (const Word& w : known) {
    const bool single =
        std::string_view(w.text).size() < 2;  // a letter is a name as a whole, or with its unit
    const bool in_it = !single && std::any_of(words.begin(), words.end(),
                                              [&](const std::string& word) { return is_word(word, w.text); });
    const bool leads = single && !words.empty() && words.front() == w.text && words.size() == 2;
    if (whole == w.text)
      best = std::max(best, 2 * w.says);
    else if (last == w.text)
      best = std::max(best, 2 * w.says - 1);
    else if (in_it || leads)
      best = std::max(best, leads ? w.says / 2 : w.says);
  }
  return best;
}

}  // namespace

int likeness(const std::string& name, ColumnRole role) {
  const std::string_view stem = stem_of(name);
  const int says = best_of(stem, words_for(role));
  if (says == 0 || says_temperature(name)) return 0;
  const std::vector<std::string> words = words_of_name(stem);
  for (const char* other : kOthers)
    if (contains(words, other)) return 0;
  const int commanded = best_of(stem, kTargets), position = best_of(stem, kPositions),
            speed = best_of(stem, kSpeeds), input = best_of(stem, kInputs);
  switch (role) {
    case ColumnRole::kTime:
      return says;
    case ColumnRole::kInput:
      return position > says || speed > says ? 0
             : commanded > 0                 ? 1
                                             : says;  // the load's position; what was measured comes first
    case ColumnRole::kPosition:
      return commanded > 0 || speed > 0 ? 0 : says;
    case ColumnRole::kSpeed:
      return commanded > 0 ? 0 : says;
    case ColumnRole::kTarget:
      return speed > 0 || input > 0 ? 0 : says + (position > 0 ? 8 : 0);
  }
  return 0;
}

int sidedness(const std::string& name, EncoderSide side) {
  const std::vector<std::string> words = words_of_name(stem_of(name));
  const auto any = [&](std::initializer_list<const char*> of_side) {
    return std::ranges::any_of(of_side, [&](const char* word) { return contains(words, word); }) ? 1 : 0;
  };
  const int to_motor =
      any({"motor", "rotor", "drive"}) - any({"load", "link", "output", "out", "joint", "last", "abtrieb"});
  return side == EncoderSide::kMotor ? to_motor : -to_motor;
}

int shared_words(const std::string& a, const std::string& b) {
  const auto parts = [](const std::string& name) {
    std::vector<std::string> all = words_of_name(name);
    std::string digits;
    for (const char c : name + " ") {
      if (std::isdigit(static_cast<unsigned char>(c)) != 0)
        digits += c;
      else if (!digits.empty())
        all.push_back(std::exchange(digits, {}));
    }
    return all;
  };
  const std::vector<std::string> of_a = parts(a), of_b = parts(b);
  return static_cast<int>(
      std::count_if(of_a.begin(), of_a.end(), [&](const std::string& w) { return contains(of_b, w); }));
}

}  // namespace gapscope::internal::inspection
