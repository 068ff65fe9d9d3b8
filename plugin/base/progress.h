// SPDX-License-Identifier: BSD-3-Clause
// What a person sees while the program works, and how to stop it.
#pragma once

#include <functional>
#include <ostream>
#include <string>

namespace curvix {

// How the program ends.
enum ExitCode : int {
  kExitSuccess = 0,
  kExitInternal = 1,     // our own mistake
  kExitCommandLine = 2,  // flags that cannot work
  kExitInput = 3,        // files or folders that are missing or broken
  kExitTool = 4,         // a program called by this one failed
  kExitNoCurves = 5,     // everything worked, and there are no curves
  kExitInterrupted = 130
};

// From now on SIGINT (Ctrl-C), SIGTERM and SIGHUP ask the program to stop; a
// second one ends it at once. Writing to a closed pipe, or more than a file may
// hold, is an error like others and no longer the end. A library that aborts
// ends the program with a sentence and kExitInternal.
void CatchSignals();
bool IsInterrupted();

// Is told what a run does, stage after stage, and may stop it.
class RunProgress {
 public:
  virtual ~RunProgress() = default;

  // The stage has done `done` of `total` steps; a new one ends the previous.
  // False: the run is to stop.
  virtual bool Update(const std::string& stage, int done, int total) = 0;

  // Ends the current stage, if any, with what it has done: "50 views", or "".
  virtual void Finish(const std::string& detail) = 0;

  // A sentence worth telling the user.
  virtual void Note(const std::string& line) = 0;

  // Whether the run is to stop, as far as is known.
  virtual bool IsCancelled() = 0;

  // Update(), for curvix::Progress; not to be called after this is gone.
  std::function<bool(const std::string&, int, int)> Callback();
};

// One line a stage. On a terminal the line is a bar with the remaining time
// until the stage ends; elsewhere the name at the start and the rest at the
// end, without control characters.
class ProgressPrinter : public RunProgress {
 public:
  // Seconds since any fixed moment.
  using Clock = std::function<double()>;

  ProgressPrinter(std::ostream& stream, bool is_terminal);
  ProgressPrinter(std::ostream& stream, bool is_terminal, Clock clock);
  ~ProgressPrinter() override;  // ends an open line
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  // The bar is redrawn at most ten times a second. False once IsInterrupted().
  bool Update(const std::string& stage, int done, int total) override;

  // "Detect edges ... 50 views, 3.1 s".
  void Finish(const std::string& detail) override;

  // Prints a line of its own, above the bar.
  void Note(const std::string& line) override;

  bool IsCancelled() override { return IsInterrupted(); }

 private:
  void Draw(int done, int total);

  std::ostream& stream_;
  const bool is_terminal_;
  const Clock clock_;
  std::string stage_;  // "": none
  double start_ = 0;
  double last_draw_ = 0;
};

}  // namespace curvix
