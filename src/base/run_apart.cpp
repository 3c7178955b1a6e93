#include "base/run_apart.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <mutex>
#include <new>
#include <string_view>
#include <utility>

#include "base/interrupt.h"
#include "gapscope/base/errors.h"

namespace gapscope {
namespace {

constexpr rlim_t kLongestS = 60;
constexpr rlim_t kMostMemory = rlim_t{2} << 30;  ///< beyond what the process has already [bytes]
constexpr int kFailed = 1, kNoMemory = 2;        ///< exit statuses

bool send(int to, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = write(to, bytes.data(), bytes.size());
    if (sent < 0 && errno != EINTR) return false;
    bytes.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(sent, 0)));
  }
  return true;
}

/// What the process has of its address space [bytes]; 0 if there is no telling.
rlim_t address_space() {
  std::ifstream pages("/proc/self/statm");
  rlim_t count = 0;
  pages >> count;
  return count * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

void limit_memory() {
  rlimit limit{};
  const rlim_t present = address_space();
  if (present == 0 || getrlimit(RLIMIT_AS, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_max, present + kMostMemory);
  setrlimit(RLIMIT_AS, &limit);
}

/// Whatever ends this process: what is said of it is said by the other one, and nothing is left behind.
void be_a_trial() {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGXCPU}) std::signal(signal, SIG_DFL);
  constexpr rlimit kNoCore{0, 0}, kTime{kLongestS, kLongestS + 1};  // SIGXCPU first, not SIGKILL
  setrlimit(RLIMIT_CORE, &kNoCore);
  setrlimit(RLIMIT_CPU, &kTime);
  limit_memory();
  if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) dup2(nowhere, STDERR_FILENO);
}

/// A lock that this process inherited would outlive its owner.
void close_others(int kept) {
  if (kept > 3) close_range(3, static_cast<unsigned>(kept) - 1, 0);
  close_range(static_cast<unsigned>(kept) + 1, ~0u, 0);
}

[[noreturn]] void work_and_end(int to, const std::function<std::string()>& work) {
  be_a_trial();
  close_others(to);
  int status = kFailed;
  try {
    if (send(to, work())) status = 0;
  } catch (const std::bad_alloc&) {
    status = kNoMemory;
  } catch (...) {
  }
  _exit(status);
}

/// All that comes until the other end is closed; nothing where that takes longer than any work may, as it
/// does where the work waits for somebody else.  @throws Interrupted
std::optional<std::string> received(int from) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::seconds(2 * kLongestS);
  std::string all;
  std::array<char, 1 << 16> piece;
  while (Clock::now() < end) {
    stop_point();
    pollfd input{from, POLLIN, 0};
    constexpr int kPatience = 100;  // milliseconds
    if (poll(&input, 1, kPatience) <= 0) continue;
    const ssize_t size = read(from, piece.data(), piece.size());
    if (size == 0) return all;
    if (size > 0) all.append(piece.data(), static_cast<std::size_t>(size));
    if (size < 0 && errno != EINTR) return all;
  }
  return {};
}

/// One process; it does not outlive its owner.
class Trial {
 public:
  explicit Trial(const std::function<std::string()>& work) {
    static std::mutex one_at_a_time;  // or another one would inherit the end that is written to
    const std::lock_guard alone(one_at_a_time);
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw MachineError("no pipe can be made, expected free file handles");
    from_ = ends[0];
    child_ = fork();
    if (child_ == 0) {
      close(ends[0]);
      work_and_end(ends[1], work);
    }
    close(ends[1]);
    if (child_ > 0) return;
    close(from_);
    throw MachineError("no process can be started, expected room for one more");
  }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;
  ~Trial() {
    close(from_);
    if (child_ > 0) kill(child_, SIGKILL), wait();
  }

  std::optional<std::string> answer() const { return received(from_); }

  /// @returns as waitpid() gives it; nothing if there is no telling
  std::optional<int> wait() {
    int status = 0;
    pid_t ended = 0;
    while ((ended = waitpid(child_, &status, 0)) < 0 && errno == EINTR) {
    }
    return ended == std::exchange(child_, 0) ? std::optional(status) : std::nullopt;
  }

 private:
  int from_ = -1;
  pid_t child_ = 0;
};

}  // namespace

std::optional<std::string> run_apart(const std::function<std::string()>& work) {
  Trial trial(work);
  std::optional<std::string> answer = trial.answer();
  if (!answer) return {};
  const std::optional<int> status = trial.wait();
  if (status && WIFSIGNALED(*status) && WTERMSIG(*status) == SIGKILL)
    throw MachineError("the process that reads a file was killed, expected that it may end");
  if (!status || !WIFEXITED(*status)) return {};
  if (WEXITSTATUS(*status) == kNoMemory) throw std::bad_alloc();
  if (WEXITSTATUS(*status) != 0) return {};
  return answer;
}

}  // namespace gapscope
