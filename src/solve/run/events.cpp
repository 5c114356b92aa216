// SPDX-License-Identifier: BSD-3-Clause
#include "solve/run/events.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace engrane::solve {

namespace {

constexpr double rounding = Switch::rounding;
/// An event is located no more sharply than this many times the time in which its switch passes through rounding.
constexpr double blurs = 4;
/// More events than this between two multiples of H are chattering, caused by the law and not by the motion.
constexpr int most_events = 40;
/// Attempts by extrapolation, and all attempts: enough bisections for any tolerance.
constexpr int quick_attempts = 6, most_attempts = 60;
/// A step that does not converge is suspected to end at an event if its initial speeds reach one within this many steps.
constexpr double foreseen = 4;
/// Number of attempts without a solution after which something else must be wrong.
constexpr int most_failures = 30;
/// The motion of switches is extrapolated over at most this many steps like the last.
constexpr double farthest = 3;
/// If no step shows how they move, the motion with the accelerations of its beginning is sampled this many times in a step.
constexpr int looks = 6;
/// An event at most this fraction of a step behind the end of the step that was to meet it is met by another attempt.
constexpr double near_miss = 0.25;

/// Least number of steps between two events: a phase that every run passes in the same steps has an error that no comparison of
/// runs shows. With n steps it goes with the fifth power of 1/n, and a smaller TOL, with which the others go, asks for more.
constexpr double least_number = 2, loosest = 2e-3, more_per_decade = 0.6;

/// A drift's error is a sixth of the cube of its fraction of a step in which accelerations change by their own size. With this
/// fraction of the cube root of TOL it is a fiftieth of TOL. Longer drifts would pass more than one event.
constexpr double part_of_root = 0.5, longest_drift = 0.05;

/// The cubic with values a, b and rates da, db at 0 and h: a + s (c1 + s (c2 + s c3)), s = t/h.
struct Cubic {
  double h, a, c1, c2, c3;
  Cubic(double y0, double v0, double y1, double v1, double step)
      : h(step), a(y0), c1(h * v0), c2(3 * (y1 - y0) - h * (2 * v0 + v1)), c3(2 * (y0 - y1) + h * (v0 + v1)) {}
  double operator()(double s) const { return a + s * (c1 + s * (c2 + s * c3)); }
  double rate(double s) const { return (c1 + s * (2 * c2 + s * 3 * c3)) / h; }
};

/// The side of a switch that has a meaning. At rounding level it is the one to which the switch is going.
int side_of(const Switch& one) { return (one.unclear() ? one.rate : one.value) < 0 ? -1 : 1; }

}  // namespace

std::optional<double> first_descent(double a, double da, double b, double db, double h, double band) {
  if (a < -band) return 0.0;
  const Cubic p(a, da, b, db, h);
  const auto [c1, c2, c3] = std::tuple(p.c1, p.c2, p.c3);
  // between its extrema, roots of c1 + 2 c2 s + 3 c3 s², the cubic is monotone
  std::array<double, 4> knots{0, 1, 1, 1};
  std::size_t count = 1;
  const double discriminant = c2 * c2 - 3 * c1 * c3;
  if (discriminant > 0) {
    const double q = -(c2 + std::copysign(std::sqrt(discriminant), c2));
    std::array<double, 2> roots{q != 0 ? c1 / q : -1, c3 != 0 ? q / (3 * c3) : -1};
    if (roots[0] > roots[1]) std::swap(roots[0], roots[1]);
    for (const double s : roots)
      if (s > 0 && s < 1) knots[count++] = s;
  }
  knots[count] = 1;
  for (std::size_t i = 0; i < count; ++i) {
    double lo = knots[i], hi = knots[i + 1];
    if (!(p(hi) < -band)) continue;
    for (int k = 0; k < 60 && hi - lo > 1e-16; ++k) {
      const double middle = 0.5 * (lo + hi);
      (p(middle) < -band ? hi : lo) = middle;
    }
    return h * hi;
  }
  return {};
}

Switches::Switches(SolverContext& context, const Scheme& scheme) : context_(context), scheme_(scheme) {
  const Numbering& numbering = context.assembler.numbering();
  for (int p = 0; p < numbering.parts(); ++p) {
    int index = 0;
    for (const SwitchNames& names : context.model.part(p).element->layout().switches) {
      const bool of_force = names.multiplier >= 0;
      const int multiplier = of_force ? numbering.multiplier_begin(p) + names.multiplier : 0;
      const int equation = of_force ? numbering.equation(numbering.motion_slots() + multiplier) : -1;
      const bool active = (!names.bend || context.options.bends) && (!of_force || equation >= 0);
      places_.push_back({p, index++, active, equation, multiplier});
      empty_ = empty_ && !active;
    }
  }
  side_.assign(places_.size(), 0);
}

std::vector<Switch> Switches::at(const Configuration& c) const {
  std::vector<Switch> values(places_.size());
  for (std::size_t i = 0; i < places_.size();) {
    const Element& element = *context_.model.part(places_[i].part).element;
    const std::size_t count = element.layout().switches.size();
    element.switches(context_.assembler.view(places_[i].part, c), std::span(values).subspan(i, count));
    for (const std::size_t end = i + count; i < end; ++i) {
      const Place& place = places_[i];
      if (!place.active) {
        values[i].size = 0;
      } else if (place.equation >= 0) {
        // a force that is less than what iterations leave, or than rounding of positions makes, has no sign
        const References& references = scheme_.references();
        const double k = context_.assembler.scale()[static_cast<std::size_t>(place.multiplier)];
        values[i].size =
            context_.options.precision / rounding * references.peak(place.equation) + k * references.length(place.equation);
      }
    }
  }
  return values;
}

std::vector<Switch> Switches::before(const Configuration& c) const {
  return !taken_.empty() && taken_at_ == c.time ? taken_ : at(c);
}

std::vector<Event> Switches::take(const Configuration& c) {
  taken_ = at(c);
  taken_at_ = c.time;
  const std::vector<Switch>& now = taken_;
  std::vector<Event> events;
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i].size == 0) {
      side_[i] = 0;
      continue;
    }
    if (now[i].unclear() && side_[i] != 0) continue;
    const int side = side_of(now[i]);
    if (side_[i] != 0 && side != side_[i]) events.push_back({places_[i].part, places_[i].index, side > 0});
    side_[i] = side;
  }
  return events;
}

void Switches::complete_sides(const Configuration& c) {
  const std::vector<Switch> now = at(c);
  for (std::size_t i = 0; i < now.size(); ++i)
    if (side_[i] == 0 && now[i].size != 0) side_[i] = side_of(now[i]);
}

std::vector<Event> Switches::renew(const Configuration& c) {
  std::vector<Event> late;
  const std::vector<Switch> now = at(c);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Layout& layout = context_.model.part(places_[i].part).element->layout();
    if (places_[i].index < static_cast<int>(layout.switches.size() - 2 * layout.grips.size())) continue;
    if (side_[i] != 0 && taken_[i].unclear() && now[i].size == 0)
      late.push_back({places_[i].part, places_[i].index, side_[i] < 0});
    side_[i] = 0;
  }
  take(c);
  return late;
}

void Switches::complete(std::vector<Switch>& from, std::vector<Switch>& to, double h) {
  for (std::size_t i = 0; i < to.size(); ++i)
    if (std::isnan(to[i].rate)) from[i].rate = to[i].rate = (to[i].value - from[i].value) / h;
}

void Switches::save(Snapshot& snapshot) const { snapshot.put("events/sides", {side_.begin(), side_.end()}); }

void Switches::load(const Snapshot& snapshot) {
  const std::vector<double>& sides = snapshot.array("events/sides");
  if (sides.size() != side_.size())
    throw std::out_of_range("the restart point has another number of contacts and stops; it may be of an earlier version");
  taken_.clear();
  std::transform(sides.begin(), sides.end(), side_.begin(), [](double side) { return static_cast<int>(side); });
}

std::optional<double> Switches::first_change(const std::vector<Switch>& from, const std::vector<Switch>& to, double h) const {
  std::optional<double> first;
  for (std::size_t i = 0; i < side_.size(); ++i) {
    if (side_[i] == 0 || to[i].size == 0) continue;
    const double s = side_[i], band = rounding * std::max(from[i].size, to[i].size);
    const auto t = first_descent(s * from[i].value, s * from[i].rate, s * to[i].value, s * to[i].rate, h, band);
    if (t && (!first || *t < *first)) first = t;
  }
  return first;
}

std::optional<double> Switches::next_change(const std::vector<Switch>& from, const std::vector<Switch>& to, double h,
                                            double ahead) const {
  std::vector<Switch> then = to;
  for (std::size_t i = 0; i < to.size(); ++i) {
    if (from[i].size == 0) then[i].size = 0;
    const Cubic path(from[i].value, from[i].rate, to[i].value, to[i].rate, h);
    then[i].value = path(1 + ahead / h);
    then[i].rate = path.rate(1 + ahead / h);
  }
  return first_change(to, then, ahead);
}

double Switches::time_to_change(const std::vector<Switch>& now, double tolerance) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < side_.size(); ++i) {
    const double value = side_[i] * now[i].value, rate = side_[i] * now[i].rate;
    if (!(rate < 0)) continue;
    const double band = rounding * now[i].size, leaves = -(value + band) / rate;
    const bool rests = value <= band && leaves > tolerance;
    least = std::min(least, rests ? leaves : std::max(0.0, -value / rate));
  }
  return least;
}

double Switches::blur(const std::vector<Switch>& now, double ahead) const {
  constexpr double about = 4;  // rates change
  double longest = 0;
  for (std::size_t i = 0; i < side_.size(); ++i) {
    const double value = side_[i] * now[i].value, rate = side_[i] * now[i].rate, band = rounding * now[i].size;
    if (value > band && value < -about * rate * ahead) longest = std::max(longest, -band / rate);
  }
  return longest;
}

EventLocator::EventLocator(SolverContext& context, Scheme& scheme)
    : scheme_(scheme), switches_(context, scheme), step_(context.options.step), sharpness_(context.options.event_tolerance) {
  step_is(step_);
  const double tolerance = context.options.tolerance;
  part_of_drift_ = std::min(longest_drift, part_of_root * std::cbrt(tolerance));
  if (tolerance > 0)
    least_ = static_cast<int>(std::round(least_number + more_per_decade * std::max(0.0, std::log10(loosest / tolerance))));
  active_ = scheme.meets_events() && context.options.events && !switches_.empty();
}

void EventLocator::step_is(double step) {
  step_ = step;
  tolerance_ = step * sharpness_;
}

double EventLocator::reach(double size) const { return std::max(tolerance_, part_of_drift_ * std::min(4 * size, step_)); }

void EventLocator::sharpen(const std::vector<Switch>& now, double ahead) {
  tolerance_ = std::max(step_ * sharpness_, std::min(blurs * switches_.blur(now, ahead), 0.5 * shortest()));
}

bool EventLocator::chatters() {
  if (!chattered_ || told_) return false;
  told_ = true;
  return true;
}

void EventLocator::save(Snapshot& snapshot) const {
  switches_.save(snapshot);
  snapshot.put("events/located", located_);
  snapshot.put("events/chattered", chattered_ ? 1 : 0);
  snapshot.put("events/told", told_ ? 1 : 0);
  std::vector<double> before;
  for (const Switch& one : before_) before.insert(before.end(), {one.value, one.rate, one.size});
  snapshot.put("events/before", std::move(before));
  snapshot.put("events/last_step", last_step_);
  snapshot.put("events/made", made_);
  snapshot.put("events/tolerance", tolerance_);
}

void EventLocator::load(const Snapshot& snapshot) {
  switches_.load(snapshot);
  located_ = static_cast<int>(snapshot.number("events/located"));
  chattered_ = snapshot.number("events/chattered") != 0;
  told_ = snapshot.number("events/told") != 0;
  const std::vector<double>& before = snapshot.array("events/before");
  before_.resize(before.size() / 3);
  for (std::size_t i = 0; i < before_.size(); ++i) before_[i] = {before[3 * i], before[3 * i + 1], before[3 * i + 2]};
  last_step_ = snapshot.number("events/last_step");
  made_ = static_cast<int>(snapshot.number("events/made"));
  tolerance_ = snapshot.number("events/tolerance");
  // a run that locates no events, as in statics, notes no switches either
  if (before_.size() != switches_.sides().size()) forget();
}

double EventLocator::foresee(const Configuration& from, double size) {
  aimed_ = 0;
  if (!active_) return size;
  std::vector<Switch> now = switches_.before(from);
  sharpen(now, size);
  std::optional<double> event;
  if (last_step_ <= 0 || size > farthest * last_step_) {
    event = coasting_change(from, std::move(now), size);
  } else {
    Switches::complete(before_, now, last_step_);
    event = switches_.next_change(before_, now, last_step_, size);
  }
  if (!event || *event <= shortest() || *event >= size) return size;
  if (const double part = *event / std::max(1, least_ - made_); part < *event) {
    if (part <= shortest()) step_is(*event);  // a phase far shorter than the steps before it
    return part;
  }
  aimed_ = size;
  return *event - 0.5 * tolerance_;
}

std::optional<double> EventLocator::coasting_change(const Configuration& from, std::vector<Switch> now, double size) const {
  const double part = size / looks;
  for (int k = 1; k <= looks; ++k) {
    std::vector<Switch> then = switches_.at(scheme_.coast(from, k * part));
    Switches::complete(now, then, part);
    if (const auto change = switches_.first_change(now, then, part)) return (k - 1) * part + *change;
    now = std::move(then);
  }
  return {};
}

void EventLocator::note_event() {
  if (++located_ == most_events) chattered_ = true;
}

std::optional<double> EventLocator::change_within(Search& s, double h) {
  std::vector<Switch> after = switches_.at(s.to);
  Switches::complete(began_, after, h);
  s.ahead = switches_.time_to_change(after, tolerance_);
  const auto change = switches_.first_change(began_, after, h);
  // the cubic predicts better than the rates at its end
  if (!change && s.ahead > tolerance_ && s.ahead < h)
    if (const auto next = switches_.next_change(began_, after, h, 2 * s.ahead)) s.ahead = *next;
  return change || s.ahead > 0.1 * tolerance_ ? change : h;
}

bool EventLocator::sees_event(Search& s, double size, Finding& found) {
  if (const auto seen = change_within(s, size)) {
    s.event = *seen;
    return true;
  }
  // a step that was to end just before an event has done so, or has narrowly missed it
  s.event = size + s.ahead;
  if (s.ahead > near_miss * size || s.event >= aimed_) return false;
  if (s.ahead <= reach(size)) {
    note_event();
    found.kind = Finding::Kind::land;
    found.drift = s.ahead + tolerance_;
    return false;
  }
  s.free = size;
  s.past = aimed_;
  return true;
}

bool EventLocator::suspects_event(Search& s, double size) const {
  // where a force jumps, a step that would end at the jump has no solution
  s.event = switches_.time_to_change(began_, tolerance_);
  if (s.event > foreseen * size) return false;
  s.event = std::min(s.event, 0.5 * size);
  s.failures = 1;
  return true;
}

bool EventLocator::drifts_at_once(Search& s, Finding& found) const {
  // an attempt that has crossed an event predicts its time poorly; over so short a time the motion at its start is better
  const std::optional<double> near = s.coasted ? s.event : coasting_change(s.from, began_, shortest());
  if (near) {
    found.kind = Finding::Kind::drift;
    found.drift = *near + tolerance_;
    return true;
  }
  s.coasted = true;
  s.event = shortest();
  return false;
}

double EventLocator::next_size(const Search& s, int attempts) const {
  // the step is to end before the event, where the law of its beginning still applies
  double size = std::max(s.event - 0.5 * tolerance_, shortest());
  if (attempts >= quick_attempts || size <= s.free || size >= s.past) size = 0.5 * (s.free + s.past);
  return s.past - s.free <= 0.5 * tolerance_ || attempts == most_attempts ? s.free : size;
}

void EventLocator::locate(Search& s, Finding& found) {
  while (found.kind == Finding::Kind::none) {
    if (s.event < shortest() && drifts_at_once(s, found)) return;
    const double size = next_size(s, found.attempts);
    const bool last = size == s.free;
    if (last && s.free == 0) {
      found.kind = Finding::Kind::drift;
      found.drift = s.past;
      return;
    }
    found.outcome = scheme_.attempt(s.from, size, s.to);
    found.step = size;
    ++found.attempts;
    if (!found.outcome->converged()) {
      if (last || ++s.failures == most_failures) found.kind = Finding::Kind::failed;
      s.past = size;
      s.event = 0.5 * (s.free + s.past);
    } else if (const auto change = change_within(s, size); last || (!change && s.ahead <= reach(size))) {
      found.kind = Finding::Kind::land;
      found.drift = std::min(s.ahead, s.past - size) + tolerance_;
    } else if (change) {
      s.past = size;
      s.event = *change;
    } else {
      s.free = size;
      s.event = s.free + s.ahead;
    }
  }
}

EventLocator::Finding EventLocator::inspect(const Configuration& from, double size, bool converged, Configuration& to) {
  Finding found;
  found.step = size;
  if (!active_) return found;
  began_ = switches_.before(from);
  sharpen(began_, size);
  if (located_ >= most_events) return found;
  Search search{from, to, 0, size};
  if (!(converged ? sees_event(search, size, found) : suspects_event(search, size))) return found;
  note_event();
  locate(search, found);
  return found;
}

}  // namespace engrane::solve
