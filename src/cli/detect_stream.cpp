// `detect --stream`: from standard input to standard output, line by line.
#include "cli/detect_stream.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "base/interrupt.h"
#include "config/configuration.h"
#include "gapscope/base/errors.h"
#include "recording/csv_stream.h"
#include "results/stream_lines.h"

namespace gapscope::cli {
namespace {

constexpr int kPatience = 100;  ///< milliseconds from Ctrl-C to the answer, where no input comes

/// Nobody reads standard output any more.
struct ReaderGone {};

/// Until a slow reader has taken what is there already.
void wait_for_reader() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  ::poll(&output, 1, -1);
}

void write_line(const std::string& line) {
  for (std::size_t done = 0; done < line.size();) {
    const ssize_t n = ::write(STDOUT_FILENO, line.data() + done, line.size() - done);
    if (n >= 0)
      done += static_cast<std::size_t>(n);
    else if (errno == EPIPE)
      throw ReaderGone{};
    else if (errno == EAGAIN)
      wait_for_reader();
    else if (errno != EINTR)
      throw std::runtime_error(std::string("standard output cannot be written: ") + std::strerror(errno));
  }
}

/// The next piece of standard input; empty at its end. @throws Interrupted also while it waits
std::string_view read_piece(std::array<char, 1 << 16>& buffer) {
  for (;;) {
    stop_point();
    pollfd input{STDIN_FILENO, POLLIN, 0};
    const int ready = ::poll(&input, 1, kPatience);
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    const ssize_t n = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    if (n >= 0) return {buffer.data(), static_cast<std::size_t>(n)};
    if (errno != EINTR && errno != EAGAIN)
      throw ConfigError("standard input",
                        fmt::format("cannot be read: {}, expected a recording as CSV", std::strerror(errno)));
  }
}

std::string resolved_settings(const RecordingColumns& columns, double quantum, double rate) {
  Configuration c;
  c.recording.emplace();
  c.recording->reading.columns = columns;
  if (rate > 0.0) c.recording->reading.resample_rate = rate;
  c.encoder.quantum = quantum;
  return resolved_reading(c);
}

class Session {
 public:
  Session(const RecordingColumns& columns, double quantum, double rate)
      : csv_("standard input", columns, rate),
        settings_(settings_line(resolved_settings(columns, quantum, rate))),
        quantum_(quantum) {}

  /// To the end of the input, or to whatever stops it; the summary comes last in any case.
  void run() {
    try {
      std::array<char, 1 << 16> buffer;
      for (std::string_view piece = read_piece(buffer); !piece.empty(); piece = read_piece(buffer))
        feed(piece);
      csv_.finish();
    } catch (const ReaderGone&) {
      throw;
    } catch (...) {
      finish();
      throw;
    }
    finish();
  }

 private:
  /// What stood before a broken line counts.
  void feed(std::string_view piece) {
    try {
      csv_.feed(piece);
    } catch (const ConfigError&) {
      detect();
      throw;
    }
    detect();
  }

  void detect() {
    if (!csv_.has_clock()) return;
    if (!detector_) begin();
    for (const CsvStream::Sample& s : csv_.take()) {
      detector_->push(s.u, s.x1);
      late_ = s.t - csv_.start() - csv_.dt() * static_cast<double>(progress_.samples++);
      progress_.until = s.t;
      tell();
    }
  }

  void begin() {
    detector_.emplace(csv_.start(), csv_.dt(), quantum_);
    write_line(settings_);
  }

  void tell() {
    if (!told_learnt_ && detector_->has_learnt()) {
      write_line(learnt_line(detector_->learnt()));
      told_learnt_ = true;
    }
    if (detector_->passages() == progress_.passages) return;
    progress_.passages = detector_->passages();
    for (GapEvent& event : detector_->take()) {
      if (std::abs(late_) > csv_.dt())
        event.t1 += late_, event.t2 += late_;  // the clock of the first rows was not exact
      write_line(event_line(event));
    }
  }

  void finish() {
    detect();
    if (!detector_) return;
    detector_->finish();
    tell();
    write_line(summary_line(detector_->estimate(), progress_));
  }

  CsvStream csv_;
  std::string settings_;
  double quantum_, late_ = 0.0;
  std::optional<StreamDetector> detector_;
  StreamProgress progress_;
  bool told_learnt_ = false;
};

}  // namespace

void detect_stream(const RecordingColumns& columns, double quantum, double resample_rate) {
  std::signal(SIGPIPE, SIG_IGN);
  try {
    Session(columns, quantum, resample_rate).run();
  } catch (const ReaderGone&) {  // as `| head` does: no fault of the recording
  }
}

}  // namespace gapscope::cli
