#include "report/changes_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "base/text.h"
#include "report/wording.h"

namespace gapscope::internal::report {
namespace {

constexpr double kWorthAWord = 0.1;  ///< of a difference, from which what explains it is told

/// The unit of u as it was declared.
std::string unit_of_u(const DriveChanges& all) {
  return all.input_unit.empty() ? "units of u" : all.coordinates.shown_unit(all.input_unit);
}

const char* source(const DriveQuantity& q) {
  if (q.from == "model_free") return "model-free";
  if (q.from == "reference") return "fitted";
  return q.from == "answer" ? "answer" : "diagnosis";
}

/// What a verdict that is none rests on.
std::string why_open(const Change& c) {
  switch (c.reason) {
    case ChangeReason::kUntold:
      return "not in both";
    case ChangeReason::kNoInterval:
      return "without an interval";
    case ChangeReason::kTheModel:
      return "in one acts what the model lacks, which moves every fitted number";
    case ChangeReason::kTheRecordings:
      return "the recordings differ by as much as explains it";
    default:
      return "the errors leave room for both";
  }
}

std::string verdict_text(const Change& c) {
  return c.verdict == ChangeVerdict::kOpen ? "open: " + why_open(c) : to_string(c.verdict);
}

bool is_closed(const Interval& i) { return std::isfinite(i.low) && std::isfinite(i.high); }

/// The quantity that a line is about.
const DriveQuantity* quantity_of(const DriveChanges& all, const std::string& from, const std::string& key,
                                 double level) {
  for (const DriveQuantity& q : all.quantities)
    if (q.from == from && q.key == key && (q.level == level || !std::isfinite(level))) return &q;
  return nullptr;
}

std::string course_sentence(const DriveChanges& all, const QuantityCourse& c) {
  const DriveQuantity* q = quantity_of(all, c.from, c.key, c.level);
  if (q == nullptr) return c.key;
  const std::string unit = changes_unit(all, *q), name = quantity_name(all, *q);
  if (c.since < 0)
    return fmt::format("{}: no change is seen, {} from report to report", name,
                       interval_text(c.slope_ci95, unit));
  const bool rose = c.after > c.before;
  const Interval by = rose ? c.step_ci95 : Interval{-c.step_ci95.high, -c.step_ci95.low};
  return fmt::format("{} is not what it was since {}: it {} from {} to {}, by {}", name,
                     all.reports.at(static_cast<std::size_t>(c.since)), rose ? "rose" : "fell",
                     quantity(c.before, unit), quantity(c.after, unit), interval_text(by, unit));
}

std::string odd_sentence(const DriveChanges& all, const OddUnit& o) {
  const DriveQuantity* q = quantity_of(all, o.from, o.key, o.level);
  if (q == nullptr) return o.key;
  const auto unit = static_cast<std::size_t>(o.report);
  return fmt::format("{} is unlike the others in {}: {}", all.reports.at(unit), quantity_name(all, *q),
                     observed_text(q->observed.at(unit), changes_unit(all, *q)));
}

/// The change that heads the text of a series: of a play where there is one, else the earliest.
const QuantityCourse* leading_course(const DriveChanges& all) {
  const QuantityCourse* lead = nullptr;
  const auto before = [](const QuantityCourse& a, const QuantityCourse& b) {
    const auto play = [](const QuantityCourse& c) { return c.key == "gap" || c.key == "lost_motion"; };
    return play(a) != play(b) ? play(a) : a.since < b.since;
  };
  for (const QuantityCourse& c : all.courses)
    if (c.since >= 0 && (lead == nullptr || before(c, *lead))) lead = &c;
  return lead;
}

std::string changed_sentence(const DriveChanges& all, const DriveQuantity& q) {
  const std::string unit = changes_unit(all, q);
  const Change& c = q.changes.back();
  const bool rose = std::isfinite(c.together.low) && c.together.low > 0.0;
  const std::string name = quantity_name(all, q);
  const Interval by = rose ? c.together : Interval{-c.together.high, -c.together.low};
  const std::string size =
      std::isfinite(by.high) ? "by " + interval_text(by, unit) : "by at least " + quantity(by.low, unit);
  return fmt::format("Changed: {} {} from {} to {}, {}", name, rose ? "rose" : "fell",
                     observed_text(q.observed.front(), unit), observed_text(q.observed.back(), unit), size);
}

/// What may explain that which no number must.
std::string rest_text(const WhichDiffers& w) {
  if (w.one_of.empty()) return ", which no one number explains";
  if (w.one_of.size() == 1) return fmt::format(", which {} alone explains", w.one_of.front());
  return fmt::format(", which any one of {} explains: the recordings do not tell them apart",
                     fmt::join(w.one_of, ", "));
}

/// ". A joint fit with all numbers alike is off by 14 encoder floors ..."
std::string held_out_text(const WhichDiffers& w) {
  if (!std::isfinite(w.off_shared) || !std::isfinite(w.off_named)) return "";
  std::string text = fmt::format(
      ". On what it has not seen, a joint fit of both with all numbers alike is off by {:.3g} encoder floors",
      w.off_shared);
  if (!w.numbers.empty()) text += fmt::format(", with what is named free by {:.3g}", w.off_named);
  return text + fmt::format(", with all of them free by {:.3g}", w.off_free);
}

/// Of what acts in one of the two, and in no model.
std::string structure_text(const DriveChanges& all) {
  const WhichDiffers& w = all.which.back();
  const bool came = w.left_now > w.left_first;
  return fmt::format(
      "In {} acts what the model lacks: it leaves {:.3g} encoder floors there, {:.3g} in {}. `gapscope diagnose` "
      "of that one names it; until then its fitted numbers say nothing of what changed",
      came ? all.reports.back() : all.reports.front(), came ? w.left_now : w.left_first,
      came ? w.left_first : w.left_now, came ? all.reports.front() : all.reports.back());
}

bool differs_in_structure(const DriveChanges& all) {
  return all.order == ReportOrder::kInTime && !all.which.empty() &&
         all.which.back().verdict == WhichVerdict::kStructure;
}

int count(const DriveChanges& all, ChangeVerdict verdict) {
  int n = 0;
  for (const DriveQuantity& q : all.quantities)
    for (const Change& c : q.changes) n += c.verdict == verdict;
  return n;
}

}  // namespace

std::string changes_unit(const DriveChanges& all, const DriveQuantity& q) {
  if (q.unit == "u") return unit_of_u(all);
  if (q.unit == "u/rad") return unit_of_u(all) + "/" + all.coordinates.position_unit();
  return all.coordinates.shown_unit(q.unit);
}

std::string quantity_name(const DriveChanges& all, const DriveQuantity& q) {
  const bool own = q.key == "lost_motion" || q.key == "loop_friction" || q.key == "flank_stiffness" ||
                   q.key == "missing_torque" || q.key == "gap" || q.key == "first_gap";
  std::string name = own ? replaced(q.key, "_", " ") : q.key;
  if (q.key == "missing_torque") name = std::string("missing ") + all.coordinates.torque_word();
  if (std::isfinite(q.level)) name += fmt::format(" at ±{}", quantity(q.level, unit_of_u(all)));
  return fmt::format("{} ({})", name, source(q));
}

std::string observed_text(const Observation& o, const std::string& unit) {
  if (o.has_value()) return plus_minus(o.value, o.ci95, unit);
  if (std::isfinite(o.at_most) && std::isfinite(o.at_least))
    return interval_text({o.at_least, o.at_most}, unit);
  if (std::isfinite(o.at_most)) return "at most " + quantity(o.at_most, unit);
  if (std::isfinite(o.at_least)) return "at least " + quantity(o.at_least, unit);
  return o.remark;
}

std::string change_text(const Change& c, const std::string& unit) {
  const std::string verdict = verdict_text(c);
  const bool part = c.by_recordings > kWorthAWord * std::abs(c.difference);
  const std::string torques =
      part ? fmt::format(" (the other torque alone can make {})", quantity(c.by_recordings, unit)) : "";
  if (std::isfinite(c.difference))
    return (c.difference > 0.0 ? "+" : "") + plus_minus(c.difference, c.ci95, unit) + torques + ", " +
           verdict;
  if (is_closed(c.ci95)) return interval_text(c.ci95, unit) + ", " + verdict;
  if (std::isfinite(c.ci95.low)) return "at least " + quantity(c.ci95.low, unit) + " more, " + verdict;
  if (std::isfinite(c.ci95.high)) return "at most " + quantity(c.ci95.high, unit) + " more, " + verdict;
  return verdict;
}

std::vector<std::string> short_names(const std::vector<std::string>& folders) {
  std::vector<std::string> names;
  for (const std::string& folder : folders) {
    const std::filesystem::path path = std::filesystem::path(folder + "/").lexically_normal().parent_path();
    names.push_back(path.filename().string());
  }
  return std::set<std::string>(names.begin(), names.end()).size() == names.size() ? names : folders;
}

std::string changes_headline(const DriveChanges& all) {
  if (all.lead < 0 && differs_in_structure(all)) return structure_text(all);
  if (all.compared == 0)
    return "Nothing to compare: " + all.reports.front() + " tells no quantity that another report tells, too";
  if (const QuantityCourse* lead = leading_course(all)) return "Changed: " + course_sentence(all, *lead);
  if (!all.courses.empty()) return "No change is seen over these reports";
  if (!all.odd.empty()) return odd_sentence(all, all.odd.front());
  if (all.order == ReportOrder::kUnits) return "No unit is unlike the others";
  if (all.lead >= 0) return changed_sentence(all, all.quantities.at(static_cast<std::size_t>(all.lead)));
  if (count(all, ChangeVerdict::kChanged) > 0)
    return "Nothing in " + all.reports.back() + " differs from " + all.reports.front() +
           " beyond the errors; other reports do, see below";
  const int same = count(all, ChangeVerdict::kSame);
  if (same == all.compared) return "The same: every difference is within the tolerance";
  return "No change is seen beyond the errors; what they leave room for is listed row by row";
}

std::string which_text(const DriveChanges& all) {
  if (all.which.empty() || all.order == ReportOrder::kUnits) return "";
  const WhichDiffers& w = all.which.back();
  if (all.lead < 0 && differs_in_structure(all)) return "";  // which is the headline
  switch (w.verdict) {
    case WhichVerdict::kNotAsked:
      return "";
    case WhichVerdict::kNone:
      return fmt::format("By the fits none of {} numbers need differ", w.compared.size()) + held_out_text(w);
    case WhichVerdict::kStructure:
      return structure_text(all);
    case WhichVerdict::kUntold:
      return "By the fits taken together something differs" + rest_text(w) + held_out_text(w);
    case WhichVerdict::kNamed:
    case WhichVerdict::kMore:
      break;
  }
  std::string text;
  for (const DifferingNumber& n : w.numbers) {
    text += text.empty() ? "By the fits what differs is " : " and ";
    text += n.key;
    if (!n.look_alikes.empty())
      text += fmt::format(" (or {}, which acts alike and is in neither fit)", fmt::join(n.look_alikes, ", "));
  }
  const std::size_t others = w.compared.size() - std::min(w.compared.size(), w.numbers.size());
  text += w.verdict == WhichVerdict::kMore ? ", and something besides" + rest_text(w)
                                           : fmt::format("; the other {} numbers need not", others);
  return text + held_out_text(w);
}

std::vector<std::string> order_lines(const DriveChanges& all) {
  std::vector<std::string> lines;
  for (const QuantityCourse& c : all.courses)
    if (&c != leading_course(all)) lines.push_back(course_sentence(all, c));
  for (std::size_t i = 1; i < all.odd.size(); ++i) lines.push_back(odd_sentence(all, all.odd[i]));
  return lines;
}

std::string changes_count(const DriveChanges& all) {
  return fmt::format(
      "{} changed, {} same, {} open, of {} differences from {} (5 % that a word of any row is wrong: "
      "intervals of {:.2f} standard errors)",
      count(all, ChangeVerdict::kChanged), count(all, ChangeVerdict::kSame),
      all.compared - count(all, ChangeVerdict::kChanged) - count(all, ChangeVerdict::kSame), all.compared,
      all.reports.front(), all.quantile);
}

}  // namespace gapscope::internal::report
