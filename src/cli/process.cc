#include "cli/process.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <string_view>
#include <thread>

#include "base/memory_budget.h"
#include "base/unfinished_files.h"
#include "facet/error.h"

namespace facet::cli {
namespace {

// Raises the signal again with its default action, so that the parent process sees why the program ended.
void OnEnd(int signal) {
  RemoveUnfinishedFiles();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

// Handles access to a page of a truncated mapped file. If several threads access one, only the first prints the error.
void OnBusError(int) {
  static std::atomic_flag met = ATOMIC_FLAG_INIT;
  while (met.test_and_set()) ::pause();
  RemoveUnfinishedFiles();
  constexpr std::string_view kLine =
      "facet: a file was cut short while it was in use; leave inputs as they are, or read them whole with --no-mmap\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kLine.data(), kLine.size());
  ::_exit(ExitCode(ErrorCode::NotFound));
}

void Handle(int signal, void (*handler)(int), int flags) {
  struct sigaction before {};
  // Signals that the caller ignores, as nohup does, stay ignored.
  if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = handler;
  ::sigemptyset(&action.sa_mask);
  action.sa_flags = flags;
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

void HandleSignals() {
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE, SIGALRM, SIGXCPU, SIGUSR1, SIGUSR2}) {
    Handle(signal, OnEnd, static_cast<int>(SA_RESETHAND | SA_NODEFER));
  }
  Handle(SIGBUS, OnBusError, 0);
  std::signal(SIGXFSZ, SIG_IGN);
}

void LimitMemory(std::uint64_t limit, int threads) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(FACET_SANITIZED)
  constexpr std::uint64_t kProgram = std::uint64_t{96} << 20, kStack = std::uint64_t{9} << 20;
  if (limit == 0) limit = DefaultMemoryLimit();
  // On top of the limit: the program and its libraries, a stack for each thread, and a quarter for heap fragmentation.
  const std::uint64_t stacks = std::max<std::uint64_t>(std::thread::hardware_concurrency(), std::uint64_t(threads));
  const std::uint64_t all = limit + limit / 4 + kProgram + stacks * kStack;
  rlimit data{};
  if (::getrlimit(RLIMIT_DATA, &data) != 0 || all >= data.rlim_cur) return;
  data.rlim_cur = all;
  ::setrlimit(RLIMIT_DATA, &data);
#else
  static_cast<void>(limit), static_cast<void>(threads);  // sanitizers reserve more memory than any limit
#endif
}

}  // namespace facet::cli
