#include "config/starter_order.h"

#include <fmt/format.h>

#include <vector>

#include "base/shell_word.h"
#include "base/shown.h"
#include "gapscope/recording/recording_file.h"
#include "inspection/reach.h"

namespace gapscope::internal::config {
namespace {

/// Which is better fitted, and what is to be said of the other one.
struct ToldOrder {
  FittingOrder order;
  std::string little;  ///< why the one that is held out judges little; empty: it does not
};

ToldOrder order_of(const RecordingConfig& config, Coordinates coordinates) {
  std::vector<MotionReach> reach;
  for (const RecordedFile& file : {config.files.front(), config.held_out.front()}) {
    const Recording r = read_recording(file.path, config.reading_of(file, UnevenRows::kStamped));
    const MotorTrace trace = r.motor_trace();
    reach.push_back(reach_of({&trace, 1}));
  }
  return {fitting_order(reach[0], reach[1], coordinates), judges_little(reach[0], reach[1])};
}

std::string command_of(const std::string& fitted, const std::string& held_out, const std::string& options) {
  constexpr std::size_t kLongest = 4000;
  return printable(fmt::format("gapscope init {} --held-out {}{}{}", shell_word(fitted), shell_word(held_out),
                               options.empty() ? "" : " ", options),
                   kLongest);
}

}  // namespace

std::string order_told(const RecordingConfig& recording, const std::string& options,
                       Coordinates coordinates) {
  const ToldOrder told = order_of(recording, coordinates);
  const std::string &fitted = recording.files.front().path, &held_out = recording.held_out.front().path;
  const std::string first = printable(fitted, 200), second = printable(held_out, 200);
  const FittingOrder& order = told.order;
  const std::string but = told.little.empty() ? "" : "; but " + second + " " + told.little;
  switch (order.fit) {
    case FittingOrder::Fit::kFirst:
      return fmt::format("{}: {} is fitted, which asks more of the drive than {} ({}){}",
                         but.empty() ? "good as it is" : "good for the fit", first, second, order.why, but);
    case FittingOrder::Fit::kSecond:
      return fmt::format(
          "better the other way round: {} asks more of the drive than {} ({}); a model is known only as "
          "far as it was fitted -> {}",
          second, first, order.why, command_of(held_out, fitted, options));
    case FittingOrder::Fit::kEither:
      break;
  }
  return fmt::format("either recording may be fitted: {}{}", order.why, but);
}

}  // namespace gapscope::internal::config
