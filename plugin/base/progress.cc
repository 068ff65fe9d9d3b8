// SPDX-License-Identifier: BSD-3-Clause
#include "plugin/base/progress.h"

#include <unistd.h>
#include <algorithm>
#include <cctype>
#include <chrono>
#include <csignal>
#include <string_view>
#include <utility>

#include "plugin/base/text.h"

namespace curvix {
namespace {

constexpr double kSecondsBetweenDraws = 0.1;
constexpr int kBarWidth = 24;
constexpr char kEraseLine[] = "\r\033[K";

volatile std::sig_atomic_t interrupted = 0;

extern "C" void OnInterrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

// Libraries abort when they get no memory.
extern "C" void OnAbort(int /*signal*/) {
  constexpr std::string_view kSentence =
      "\nERROR: A library gave up, most likely for want of memory; nothing was "
      "written. Please report it if there is enough.\n";
  [[maybe_unused]] const auto written =
      write(STDERR_FILENO, kSentence.data(), kSentence.size());
  _exit(kExitInternal);
}

// A signal that the caller ignores, as nohup does, stays ignored.
void Catch(int signal) {
  if (std::signal(signal, OnInterrupt) == SIG_IGN) {
    std::signal(signal, SIG_IGN);
  }
}

double SteadySeconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

// "detect_edges" as "Detect edges".
std::string Title(std::string stage) {
  std::ranges::replace(stage, '_', ' ');
  if (!stage.empty()) {
    stage[0] = static_cast<char>(
        std::toupper(static_cast<unsigned char>(stage.front())));
  }
  return stage;
}

}  // namespace

void CatchSignals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) Catch(signal);
  // A write that fails says so by itself.
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  std::signal(SIGABRT, OnAbort);
}

bool IsInterrupted() { return interrupted != 0; }

ProgressPrinter::ProgressPrinter(std::ostream& stream, bool is_terminal)
    : ProgressPrinter(stream, is_terminal, SteadySeconds) {}

ProgressPrinter::ProgressPrinter(std::ostream& stream,
                                 bool is_terminal,
                                 Clock clock)
    : stream_(stream), is_terminal_(is_terminal), clock_(std::move(clock)) {}

ProgressPrinter::~ProgressPrinter() {
  if (!stage_.empty()) stream_ << std::endl;
}

bool ProgressPrinter::Update(const std::string& stage, int done, int total) {
  if (stage != stage_) {
    Finish("");
    stage_ = stage;
    start_ = clock_();
    last_draw_ = start_ - 1;
    if (!is_terminal_) stream_ << Title(stage) << " ... " << std::flush;
  }
  if (is_terminal_ && clock_() - last_draw_ >= kSecondsBetweenDraws) {
    Draw(done, total);
  }
  return !IsInterrupted();
}

std::function<bool(const std::string&, int, int)> RunProgress::Callback() {
  return [this](const std::string& stage, int done, int total) {
    return Update(stage, done, total);
  };
}

void ProgressPrinter::Finish(const std::string& detail) {
  if (stage_.empty()) return;
  if (is_terminal_) stream_ << kEraseLine << Title(stage_) << " ... ";
  stream_ << detail << (detail.empty() ? "" : ", ")
          << DurationText(clock_() - start_) << std::endl;
  stage_.clear();
}

void ProgressPrinter::Note(const std::string& line) {
  if (!stage_.empty()) stream_ << (is_terminal_ ? kEraseLine : "\n");
  stream_ << ForTerminal(line) << std::endl;
  last_draw_ -= 1;
}

void ProgressPrinter::Draw(int done, int total) {
  last_draw_ = clock_();
  stream_ << kEraseLine << Title(stage_) << " ";
  if (total > 0) {
    const double share = std::clamp(static_cast<double>(done) / total, 0., 1.);
    const int filled = static_cast<int>(share * kBarWidth);
    stream_ << "[" << std::string(static_cast<std::size_t>(filled), '=')
            << std::string(static_cast<std::size_t>(kBarWidth - filled), ' ')
            << "] " << done << "/" << total;
    const double elapsed = last_draw_ - start_;
    if (share > 0 && elapsed > 0.5) {
      stream_ << ", " << DurationText(elapsed * (1 - share) / share) << " left";
    }
  }
  stream_ << std::flush;
}

}  // namespace curvix
