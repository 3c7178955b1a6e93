#pragma once
// What another process does at the very moment when this one renames or removes a file. A filter of the
// system calls hands them to a handler here, in a child process, as the filter is for life.
#include <gtest/gtest.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <ucontext.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <exception>
#include <functional>
#include <string>

namespace gapscope::testing {

/// @param moment  counts from 1: odd ones are before a call, even ones after it
/// @returns the error that a call is to end with in its stead; 0: it is made
using Company = std::function<int(int moment, long call)>;

#ifdef __x86_64__

namespace company {

constexpr unsigned kPass = 0x6a9c0de5;  // in an argument that none of the calls has
inline Company act;
inline int moment = 0;
inline bool acting = false;

inline void at_call(int, siginfo_t*, void* context) {
  auto& r = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  const long call = r[REG_RAX];
  const auto tell = [&] {
    if (acting) return 0;
    acting = true;
    const int error = act(++moment, call);
    acting = false;
    return error;
  };
  const int error = tell();
  const long done =
      error != 0 ? -1 : syscall(call, r[REG_RDI], r[REG_RSI], r[REG_RDX], r[REG_R10], r[REG_R8], kPass);
  r[REG_RAX] = done >= 0 ? done : error != 0 ? -error : -errno;
  tell();
}

/// rename, renameat2, link, unlink: the others of the family are not used.
inline bool begin() {
  struct sigaction action {};
  action.sa_sigaction = at_call;
  action.sa_flags = SA_SIGINFO | SA_NODEFER;
  sigaction(SIGSYS, &action, nullptr);
  std::array<sock_filter, 11> filter = {{
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, AUDIT_ARCH_X86_64, 0, 8),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_rename, 3, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_renameat2, 2, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_link, 1, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_unlink, 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args[5])),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kPass, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  }};
  sock_fprog program{filter.size(), filter.data()};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

}  // namespace company

/// Whether this system lets a process filter its own calls.
inline bool company_can_come() {
  const pid_t child = fork();
  if (child == 0) _exit(company::begin() ? 0 : 1);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// How work ended that had company.
struct Ended {
  std::string refusal;  ///< what it threw, in words
  int moments = 0;      ///< that there were
};

template <class Work>
Ended in_company(const Company& act, Work work) {
  int channel[2];
  if (pipe(channel) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    company::act = act;
    std::string what;
    try {
      if (company::begin()) work();
    } catch (const std::exception& error) {
      what = error.what();
    }
    company::acting = true;
    what = std::to_string(company::moment) + " " + what;
    const ssize_t told = ::write(channel[1], what.data(), what.size());
    _exit(told < 0 ? 1 : 0);
  }
  close(channel[1]);
  std::string text(4000, '\0');
  const ssize_t size = ::read(channel[0], text.data(), text.size());
  close(channel[0]);
  int status = 0;
  waitpid(child, &status, 0);
  text.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
  if (text.empty()) return {"", 0};  // it was ended on its way
  return {text.substr(text.find(' ') + 1), std::stoi(text)};
}

#else  // the registers of other machines have other names

struct Ended {
  std::string refusal;
  int moments = 0;
};
inline bool company_can_come() { return false; }
template <class Work>
Ended in_company(const Company&, Work) {
  return {};
}

#endif

}  // namespace gapscope::testing
