// SPDX-License-Identifier: BSD-3-Clause
#include "output/checks.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/text.hpp"

namespace engrane::output {

namespace {

constexpr double default_tolerance = 1e-6;

/// Value at `time` of the polynomial through the samples (Neville's algorithm).
template <class Samples>
double interpolated(const Samples& samples, double time) {
  std::vector<double> p;
  for (const auto& s : samples) p.push_back(s.value);
  for (std::size_t width = 1; width < p.size(); ++width)
    for (std::size_t i = 0; i + width < p.size(); ++i) {
      const double a = samples[i].time, b = samples[i + width].time;
      p[i] = ((b - time) * p[i] + (time - a) * p[i + 1]) / (b - a);
    }
  return p.front();
}

}  // namespace

bool is_over_time(const deck::CheckCard& card) { return card.measure.given() && !card.measure.is("VALUE"); }

std::string check_title(const deck::CheckCard& card) {
  std::string title = card.element ? "ELEMENT " + std::to_string(*card.element) + " "
                      : card.node  ? "NODE " + std::to_string(*card.node) + " "
                                   : "RUN ";
  title += card.quantity;
  if (!is_over_time(card)) return title + (card.time ? " at t = " + format_number(*card.time) : " at the end");
  title = card.measure.tag + " of " + title;
  if (card.window.size() == 2) title += " from t = " + format_number(card.window[0]) + " to " + format_number(card.window[1]);
  return title;
}

Checks::Checks(std::vector<Resolved> checks) {
  for (Resolved& check : checks) {
    checks_.emplace_back();
    if (const std::vector<double>& limits = check.card.window; limits.size() == 2)
      checks_.back().window = Window(limits[0], limits[1]);
    checks_.back().resolved = std::move(check);
  }
}

double Checks::slack(double time) const {
  return std::max(1e-9 * last_step_, 8 * std::numeric_limits<double>::epsilon() * std::abs(time));
}

void Checks::observe(double time, std::span<const double> values, bool regular, bool corner) {
  // a repeated time must not change the step length
  const bool repeated = started_ && time <= last_time_;
  if (started_ && !repeated) last_step_ = time - last_time_;
  for (Measured& m : checks_) {
    if (!m.seen) m.first_time = time;
    assert(m.resolved.channel < values.size());
    const Sample sample{time, values[m.resolved.channel]};
    if (is_over_time(m.resolved.card))
      m.window.add(time, sample.value, corner, slack(time));
    else
      observe_value(m, sample, regular, corner);
    m.last_value = sample.value;
    m.seen = true;
  }
  last_time_ = time;
  started_ = true;
}

void Checks::observe_value(Measured& m, Sample sample, bool regular, bool corner) const {
  if (!m.resolved.card.time || !(regular || corner)) return;  // the last sample is kept for every check
  const double wanted = *m.resolved.card.time;
  const auto put = [&sample](std::vector<Sample>& samples) {
    if (!samples.empty() && sample.time <= samples.back().time) samples.pop_back();
    samples.push_back(sample);
  };
  if (std::abs(sample.time - wanted) <= slack(wanted)) {
    m.before = {sample};
    m.exact = true;
  } else if (m.exact) {
    return;
  } else if (sample.time < wanted) {
    if (corner) m.before.clear();
    put(m.before);
    if (m.before.size() > 3) m.before.erase(m.before.begin());
  } else if (!m.closed && (m.after.size() < 3 || sample.time <= m.after.back().time)) {
    put(m.after);
    m.closed = corner;
  }
}

double Checks::value(const Measured& m, std::string& remark) const {
  const deck::CheckCard& card = m.resolved.card;
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  if (!m.seen) {
    remark = "the run has no results";
    return nothing;
  }
  const auto too_late = [&](double t) {
    if (last_time_ >= t - slack(t)) return false;
    remark = "the run ended at t = " + format_number(last_time_);
    return true;
  };
  const auto too_early = [&](double t) {
    if (m.first_time <= t + slack(t)) return false;
    remark = "the run started at t = " + format_number(m.first_time);
    return true;
  };
  if (!is_over_time(card)) {
    if (!card.time) return m.last_value;
    if (too_late(*card.time) || too_early(*card.time)) return nothing;
    // two samples on either side, or more on one side near the ends of the run
    if (m.exact) return m.before.front().value;
    const std::size_t before = std::min(m.before.size(), 4 - std::min<std::size_t>(m.after.size(), 2));
    const std::size_t after = std::min(m.after.size(), 4 - before);
    std::vector<Sample> around(m.before.end() - static_cast<std::ptrdiff_t>(before), m.before.end());
    around.insert(around.end(), m.after.begin(), m.after.begin() + static_cast<std::ptrdiff_t>(after));
    return interpolated(around, *card.time);
  }
  if (card.window.size() == 2 && (too_late(card.window[1]) || too_early(card.window[0]))) return nothing;
  const Window::Measures found = m.window.measures();
  if (card.measure.is("MIN")) return found.least;
  if (card.measure.is("MAX")) return found.largest;
  if (card.measure.is("AMPLITUDE")) return (found.largest - found.least) / 2;
  return card.measure.is("RMS") ? found.rms : found.mean;
}

CheckResult Checks::result(const Measured& m) const {
  const deck::CheckCard& card = m.resolved.card;
  CheckResult r;
  r.text = check_title(card);
  r.expected = card.value;
  r.reference = card.reference;
  const double relative = card.relative ? *card.relative : card.absolute ? 0 : default_tolerance;
  r.tolerance = std::max(card.absolute.value_or(0), relative * std::abs(card.value));
  r.value = value(m, r.remark);
  // written so that NaN fails
  r.passed = std::abs(r.value - r.expected) <= r.tolerance;
  if (!std::isfinite(r.value) && r.remark.empty()) r.remark = "the value is not a finite number";
  return r;
}

void Checks::save(Snapshot& snapshot) const {
  if (!started_) return;
  snapshot.put("checks/times", {last_time_, last_step_});
  for (const Measured& m : checks_) {
    std::vector<double> state{m.first_time, m.last_value, m.exact ? 1.0 : 0.0, m.closed ? 1.0 : 0.0,
                              static_cast<double>(m.before.size())};
    for (const auto* samples : {&m.before, &m.after})
      for (const Sample& sample : *samples) state.insert(state.end(), {sample.time, sample.value});
    const std::string name = "checks/" + check_title(m.resolved.card);
    snapshot.put(name, std::move(state));
    snapshot.put(name + " window", m.window.save());
  }
}

void Checks::load(const Snapshot& snapshot) {
  if (!snapshot.has("checks/times")) return;
  const std::vector<double>& times = snapshot.array("checks/times");
  last_time_ = times.at(0);
  last_step_ = times.at(1);
  started_ = true;
  for (Measured& m : checks_) {
    const std::string name = "checks/" + check_title(m.resolved.card);
    if (!snapshot.has(name)) continue;
    const std::vector<double>& state = snapshot.array(name);
    m.seen = true;
    m.first_time = state.at(0);
    m.last_value = state.at(1);
    m.exact = state.at(2) != 0;
    m.closed = state.at(3) != 0;
    const auto before = static_cast<std::size_t>(state.at(4));
    m.before.clear();
    m.after.clear();
    m.window.load(snapshot.array(name + " window"));
    for (std::size_t i = 5; i + 1 < state.size(); i += 2)
      (m.before.size() < before ? m.before : m.after).push_back({state[i], state[i + 1]});
  }
}

std::vector<CheckResult> Checks::results() const {
  std::vector<CheckResult> all;
  for (const Measured& m : checks_) all.push_back(result(m));
  return all;
}

}  // namespace engrane::output
