// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <utility>

namespace engrane::output {

/// Shows the progress of a run on standard error, so that standard output stays clean. On a terminal it is one line that is
/// overwritten. Otherwise a line is printed every tenth of the run or every half minute, whichever comes first, but at least a
/// second after the last one.
class Progress {
 public:
  enum class Style : unsigned char { terminal, lines, silent };
  /// The style that suits standard error.
  static Style suitable();

  /// From `start` to `end` of `.SUB`.
  Progress(double start, double end, Style style = suitable());
  /// The same on any stream and clock (seconds), for tests.
  Progress(double start, double end, Style style, std::ostream& out, std::function<double()> clock);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Sets a prefix for each line, for a run other than the main one.
  void label(std::string text) { label_ = std::move(text); }
  /// Call after each accepted step: the time reached, the step length and the number of steps so far.
  void update(double time, double step, long steps);
  /// Prints whole lines of text without mixing them with the progress line.
  void note(const std::string& text);
  /// Removes the progress line. The destructor does so too.
  void finish();

 private:
  std::string line(double time, double step, long steps, double now) const;
  void clear();

  std::string label_;
  double start_, end_;
  Style style_;
  std::ostream& out_;
  std::function<double()> clock_;
  double began_;
  double last_shown_;
  int last_tenth_ = 0;
  double rate_since_ = 0;  ///< the rate is measured over the last seconds, not the whole run
  long rate_steps_ = 0;
  double rate_ = 0;
  std::size_t width_ = 0;  ///< of the line on the terminal; 0 if there is none
};

/// `3 s`, `4 min 05 s`, `2 h 13 min`.
std::string duration_text(double seconds);

}  // namespace engrane::output
