// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/mobility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "solve/constraints/constraint_factors.hpp"
#include "solve/constraints/islands.hpp"
#include "solve/constraints/least_norm.hpp"
#include "solve/constraints/leaves.hpp"
#include "solve/constraints/redundancy_advice.hpp"

namespace engrane::solve {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// Row of the largest entry of a column, −1 if there is none, and its magnitude.
std::pair<int, double> largest_entry(const Sparse& a, Eigen::Index column) {
  std::pair<int, double> largest{-1, 0.0};
  for (Sparse::InnerIterator it(a, column); it; ++it)
    if (std::abs(it.value()) > largest.second) largest = {static_cast<int>(it.row()), std::abs(it.value())};
  return largest;
}

/// Exchanges dependent constraints for grips and drives that they depend on, the last in the deck first. Friction gives way to
/// whatever else moves or holds its surfaces. A drive that asks for what the joints forbid is then left out, found open, and
/// named, and no joint opens in its place.
void prefer_grips_and_drives(const Model& model, const Numbering& numbering, Sparse& null, std::vector<int>& dependent) {
  constexpr double significant = 1e-3;
  std::vector<std::pair<bool, int>> preferred;  // whether a grip, and the multiplier
  for (Eigen::Index j = 0; j < null.cols(); ++j)
    for (Sparse::InnerIterator it(null, j); it; ++it) {
      const auto m = static_cast<int>(it.row());
      const Unknown& u = numbering.multiplier(m);
      if (is_grip(model, u) || is_drive(model, u)) preferred.emplace_back(is_grip(model, u), m);
    }
  std::sort(preferred.begin(), preferred.end(), std::greater<>());
  preferred.erase(std::unique(preferred.begin(), preferred.end()), preferred.end());
  if (preferred.empty()) return;
  std::vector<Eigen::SparseVector<double>> columns;
  for (Eigen::Index j = 0; j < null.cols(); ++j) columns.emplace_back(null.col(j));
  std::vector<bool> taken(columns.size(), false);
  for (const auto& [grip, one] : preferred) {
    std::size_t best = columns.size();
    double largest = significant;
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const double part = std::abs(columns[j].coeff(one)) / columns[j].coeffs().abs().maxCoeff();
      if (taken[j] || part < largest) continue;
      largest = part;
      best = j;
    }
    if (best == columns.size()) continue;
    taken[best] = true;
    const Eigen::SparseVector<double> chosen = columns[best] / columns[best].coeff(one);
    for (std::size_t j = 0; j < columns.size(); ++j)
      if (const double part = columns[j].coeff(one); part != 0 && j != best)
        columns[j] = (columns[j] - part * chosen).pruned(1.0, 1e-14);
    columns[best] = chosen;
    dependent[best] = one;
  }
  for (std::size_t j = 0; j < columns.size(); ++j) null.col(static_cast<Eigen::Index>(j)) = columns[j];
  std::sort(dependent.begin(), dependent.end());
}

/// Replaces the dependent constraints of each island by those of a position `there` where it has fewer. Returns how many fewer.
int take_larger_rank(const Islands& islands, const ConstraintFactors& here, const ConstraintFactors& there, Mobility& found) {
  std::vector<int> more(islands.count(), 0);
  for (const int m : here.dependent()) ++more[islands.of_multiplier(m)];
  for (const int m : there.dependent()) --more[islands.of_multiplier(m)];
  std::vector<std::tuple<int, const ConstraintFactors*, Eigen::Index>> chosen;  // dependent constraint, and its null vector
  for (const ConstraintFactors* const factors : {&here, &there})
    for (std::size_t j = 0; j < factors->dependent().size(); ++j)
      if (const int m = factors->dependent()[j]; (more[islands.of_multiplier(m)] > 0) == (factors == &there))
        chosen.emplace_back(m, factors, static_cast<Eigen::Index>(j));
  std::sort(chosen.begin(), chosen.end(), [](const auto& a, const auto& b) { return std::get<0>(a) < std::get<0>(b); });
  found.dependent.clear();
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [m, factors, column] : chosen) {
    for (Sparse::InnerIterator it(factors->null_multipliers(), column); it; ++it)
      entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(found.dependent.size()), it.value());
    found.dependent.push_back(m);
  }
  found.null.resize(here.columns(), static_cast<Eigen::Index>(chosen.size()));
  found.null.setFromTriplets(entries.begin(), entries.end());
  return std::accumulate(more.begin(), more.end(), 0, [](int sum, int n) { return sum + std::max(n, 0); });
}

/// Groups of constraints that null vectors combine.
std::vector<RedundantGroup> group(const Sparse& null) {
  std::vector<int> leader(static_cast<std::size_t>(null.rows()));
  std::iota(leader.begin(), leader.end(), 0);
  const auto find = [&](int m) {
    while (leader[static_cast<std::size_t>(m)] != m) {
      int& up = leader[static_cast<std::size_t>(m)];
      m = up = leader[static_cast<std::size_t>(up)];
    }
    return m;
  };
  std::vector<int> first_of(static_cast<std::size_t>(null.cols()), -1);
  std::vector<bool> takes_part(leader.size(), false);
  for (Eigen::Index j = 0; j < null.cols(); ++j) {
    const double size = largest_entry(null, j).second;
    for (Sparse::InnerIterator it(null, j); it; ++it) {
      if (std::abs(it.value()) < 1e-6 * size) continue;
      const auto m = static_cast<int>(it.row());
      takes_part[static_cast<std::size_t>(m)] = true;
      int& first = first_of[static_cast<std::size_t>(j)];
      if (first < 0)
        first = m;
      else
        leader[static_cast<std::size_t>(find(m))] = find(first);
    }
  }
  std::map<int, RedundantGroup> groups;
  for (std::size_t m = 0; m < leader.size(); ++m)
    if (takes_part[m]) groups[find(static_cast<int>(m))].members.push_back(static_cast<int>(m));
  for (const int first : first_of) ++groups[find(first)].redundant;
  std::vector<RedundantGroup> all;
  for (auto& [first, one] : groups) all.push_back(std::move(one));
  return all;
}

std::string along(const Vec3& direction) {
  for (int i = 0; i < 3; ++i)
    if (std::abs(direction[i]) > 1 - 1e-9) return std::string(1, "xyz"[i]);
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", direction[0], direction[1], direction[2]);
}

/// "force along z", from the gradient of the constraint; for an element that is no joint, its own words.
std::string describe_direction(Assembler& assembler, const Configuration& c, const Unknown& u) {
  const Model::Part& part = assembler.model().parts[static_cast<std::size_t>(u.part)];
  const Layout& layout = part.element->layout();
  const Multiplier& named = layout.multipliers[static_cast<std::size_t>(u.item)];
  const bool force = named.role == Role::force, moment = named.role == Role::moment;
  if (!force && !moment) return named.role == Role::tooth ? "tooth force" : named.help;
  const std::size_t n = static_cast<std::size_t>(layout.slots()), nodes = part.nodes.size();
  const auto k = assembler.element_tangent(u.part, c, {1, 0, 0}).k;
  const std::size_t row = n - layout.multipliers.size() + static_cast<std::size_t>(u.item);
  for (std::size_t i = nodes; i-- > 0;) {
    const int slot = layout.node_slot(i, force ? NodeNeed::translation : NodeNeed::rotation);
    if (slot < 0) continue;
    const double* g = k.data() + row * n + static_cast<std::size_t>(slot);
    Vec3 direction(g[0], g[1], g[2]);
    if (direction.norm() < 1e-9) continue;
    if (moment) direction = c.nodes[static_cast<std::size_t>(part.nodes[i])].R * direction;
    return fmt::format("{} {}", force ? "force along" : "moment about", along(direction.normalized()));
  }
  return named.help;
}

std::string names(Assembler& assembler, const Configuration& c, const std::vector<int>& members) {
  constexpr int most = 12;
  std::string text;
  int part = -1, elements = 0;
  std::map<int, std::size_t> directions;
  for (const int m : members) ++directions[assembler.numbering().multiplier(m).part];
  bool all = false;
  std::size_t unnamed = 0;
  for (const int m : members) {
    const Unknown& u = assembler.numbering().multiplier(m);
    if (u.part != part) {
      part = u.part;
      if (elements++ >= most) {
        ++unnamed;
        continue;
      }
      const Model::Part& owner = assembler.model().parts[static_cast<std::size_t>(part)];
      text += fmt::format("{}{} (", elements > 1 ? "), " : "", owner.name());
      all = directions[part] > 3 && directions[part] == owner.element->layout().multipliers.size();
      text += all ? "in all directions that it holds" : describe_direction(assembler, c, u);
    } else if (elements <= most && !all) {
      text += ", " + describe_direction(assembler, c, u);
    }
  }
  if (!text.empty()) text += ")";
  if (unnamed > 0) text += fmt::format(" and {} more", unnamed);
  return text;
}

std::string counted(int number, const char* what) { return fmt::format("{} {}{}", number, what, number == 1 ? "" : "s"); }

/// Change of the forces in each motion slot when the multipliers of `from` become those of `to`.
Vector change_of_forces(Assembler& assembler, const Configuration& from, const Configuration& to) {
  Vector change = Vector::Zero(assembler.numbering().slots());
  std::vector<double> before;
  const auto& parts = assembler.model().parts;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto part = static_cast<int>(p);
    const auto begin = static_cast<std::size_t>(assembler.numbering().multiplier_begin(part));
    const std::size_t count = parts[p].element->layout().multipliers.size();
    if (std::equal(from.multipliers.begin() + static_cast<long>(begin),
                   from.multipliers.begin() + static_cast<long>(begin + count),
                   to.multipliers.begin() + static_cast<long>(begin)))
      continue;
    const auto& slots = assembler.numbering().part_slots(part);
    const auto first = assembler.element_residual(part, from);
    before.assign(first.begin(), first.end());
    const auto after = assembler.element_residual(part, to);
    for (std::size_t i = 0; i < slots.size(); ++i) change[slots[i]] += after[i] - before[i];
  }
  return change;
}

/// Whether the element that owns a multiplier has friction.
bool has_friction(const Assembler& assembler, int multiplier) {
  const int part = assembler.numbering().multiplier(multiplier).part;
  return part >= 0 && assembler.model().part(part).element->layout().has_friction();
}

/// Constraints that steps close to their tolerance leave dependent ones open, and their gradients independent, by a few times as
/// much.
constexpr double as_exact = 10;

/// The smallest multipliers, times their weights, with the same effect through these columns as each column of `x`.
Eigen::MatrixXd least_alike(const ConstraintMatrix& columns, const Vector& weight, const Eigen::MatrixXd& x) {
  return RowSpace(with_columns_scaled(columns.matrix, weight.cwiseInverse()), rank_tolerance, columns.rows.first_rows).part(x);
}

constexpr const char* usual_cure =
    "leave one of these directions free in one of the joints, or give it a stiffness instead (KM for teeth)";

}  // namespace

Mobility analyse_mobility(Assembler& assembler, const MotionSlots& motion, const Configuration& configuration, double tolerance) {
  Mobility found;
  found.analysed = true;
  if (const Numbering& numbering = assembler.numbering(); numbering.slots() == numbering.motion_slots()) {
    found.motions = numbering.equations();  // without constraints all are free
    return found;
  }
  Configuration c = at_start_of_step(configuration);
  const ConstraintFactors here(assembler, c, ConstraintColumns::gradients, tolerance);
  found.motions = static_cast<int>(here.rows());
  found.constraints = static_cast<int>(here.columns()) - assembler.idle_count();
  found.rank = static_cast<int>(here.rank());
  if (here.deficiency() == 0) return found;
  const std::vector<double> phi = assembler.violations(c);
  found.dependent = here.dependent();
  found.null = here.null_multipliers();
  if (const Islands islands(assembler); found.freedom() > 0 && move_along(assembler, motion, islands, here, c, tolerance)) {
    const ConstraintFactors there(assembler, c, ConstraintColumns::gradients, tolerance);
    found.lost_here = take_larger_rank(islands, here, there, found);
    found.rank += found.lost_here;
  }
  prefer_grips_and_drives(assembler.model(), assembler.numbering(), found.null, found.dependent);
  found.groups = group(found.null);
  const Vector relative = relative_open(assembler, phi);
  for (RedundantGroup& one : found.groups)
    for (const int m : one.members) {
      if (relative[m] < one.relative) continue;
      one.relative = relative[m];
      one.open = std::abs(phi[static_cast<std::size_t>(m)]);
      one.widest = m;
    }
  return found;
}

std::string friction_on_redundant(const Assembler& assembler, const Mobility& mobility) {
  std::set<int> parts;
  for (const RedundantGroup& one : mobility.groups)
    for (const int m : one.members)
      if (has_friction(assembler, m)) parts.insert(assembler.numbering().multiplier(m).part);
  std::string text;
  for (const int p : parts) text += (text.empty() ? "" : ", ") + assembler.model().part(p).name();
  return text;
}

std::string describe_mobility(Assembler& assembler, const Configuration& configuration, const Mobility& mobility) {
  if (!mobility.analysed) return "";
  std::string text = fmt::format("  {} ({} free motions, {} independent constraints)\n",
                                 counted(mobility.freedom(), "degree") + " of freedom", mobility.motions, mobility.rank);
  if (mobility.lost_here > 0)
    text += fmt::format("  the start is a singular position: {} more there alone\n", mobility.lost_here);
  if (mobility.redundant() == 0) return text;
  const Configuration c = at_start_of_step(configuration);
  for (const RedundantGroup& one : mobility.groups)
    text += fmt::format("  {} among {}\n", counted(one.redundant, "redundant constraint"), names(assembler, c, one.members));
  const std::string friction = friction_on_redundant(assembler, mobility);
  text +=
      friction.empty()
          ? "  They agree with one another. The motion and the sums of forces are determined; how these reactions share a load "
            "is not unique: the least ones are given.\n"
          : fmt::format(
                "  They agree with one another. How these reactions share a load is not unique: the least ones are "
                "taken. Friction in {} depends on them, and so does the motion.\n",
                friction);
  const std::string cure = suggest_releases(assembler, mobility.null);
  return text + fmt::format("  For reactions of a real machine {}.\n", cure.empty() ? usual_cure : cure);
}

bool Redundancy::analyse(const Configuration& c, double tolerance) {
  std::vector<int> before = mobility_.dependent;
  mobility_ = analyse_mobility(assembler_, motion_, c, tolerance);
  assembler_.release(mobility_.dependent, c.multipliers);
  return before != mobility_.dependent;
}

bool Redundancy::renew(const Configuration& c) {
  constexpr double most = 1e-4;
  const double open = relative_open(assembler_, assembler_.violations(c)).lpNorm<Eigen::Infinity>();
  return analyse(c, std::clamp(as_exact * open, rank_tolerance, most));
}

std::string Redundancy::conflict(const Configuration& c) {
  if (!active()) return {};
  const std::vector<double> phi = assembler_.violations(c);
  const Vector relative = relative_open(assembler_, phi);
  const Numbering& numbering = assembler_.numbering();
  const auto is_released = [&](int m) { return std::binary_search(mobility_.dependent.begin(), mobility_.dependent.end(), m); };
  for (const RedundantGroup& one : mobility_.groups) {
    double closed = consistent;
    for (const int m : one.members)
      if (!is_released(m)) closed = std::max(closed, as_exact * relative[m]);
    for (const int m : one.members) {
      const double open = phi[static_cast<std::size_t>(m)];
      if (!is_released(m)) continue;
      const Unknown& u = numbering.multiplier(m);
      if (relative[m] <= closed || is_grip(assembler_.model(), u)) continue;  // a grip gives way (Grips)
      const bool length = u.measure == Measure::length;
      return fmt::format("conflicting constraints: {} stays open by {:.3g} {} when the others are closed; {} among {}: {}",
                         numbering.describe(numbering.equation(u.slot)), std::abs(open),
                         assembler_.model().units.label(length ? dimension::length : dimension::angle),
                         counted(one.redundant, "constraint") + " too many", names(assembler_, at_start_of_step(c), one.members),
                         cure_of(one));
    }
  }
  return {};
}

std::string Redundancy::cure_of(const RedundantGroup& one) const {
  // of drives the last in the deck, as the one that was added to what moved before
  for (auto m = one.members.rbegin(); m != one.members.rend(); ++m) {
    const Unknown& u = assembler_.numbering().multiplier(*m);
    const Model::Part& part = assembler_.model().parts[static_cast<std::size_t>(u.part)];
    if (!is_drive(assembler_.model(), u)) continue;
    return fmt::format(
        "the joints leave a drive no freedom, or drives disagree: see whether a place, an axis or a drive's function is wrong, "
        "or leave out the drive of {}",
        part.name());
  }
  Sparse null(mobility_.null.rows(), one.redundant);
  Eigen::Index count = 0;
  // a combination belongs to the group of its largest entry
  for (Eigen::Index j = 0; j < mobility_.null.cols() && count < one.redundant; ++j)
    if (std::binary_search(one.members.begin(), one.members.end(), largest_entry(mobility_.null, j).first))
      null.col(count++) = mobility_.null.col(j);
  const std::string cure = count == one.redundant ? suggest_releases(assembler_, null) : "";
  return "make the places and axes agree, or " + (cure.empty() ? "free that direction in one of the joints" : cure);
}

std::string Redundancy::rate_conflict(const Configuration& c, const std::vector<double>& rate, double speed) {
  const Numbering& numbering = assembler_.numbering();
  const Vector relative = relative_open(assembler_, rate);
  // a speed that opens nothing in the whole run is the rounding of a machine at rest
  constexpr double opens_never = 1e-12;
  const double span = assembler_.model().commands.stepping.end - assembler_.model().commands.stepping.start;
  for (const RedundantGroup& one : mobility_.groups)
    for (const int m : one.members) {
      if (!std::binary_search(mobility_.dependent.begin(), mobility_.dependent.end(), m)) continue;
      const Unknown& u = numbering.multiplier(m);
      if (relative[m] <= 1e-8 * speed || relative[m] * span <= opens_never || is_grip(assembler_.model(), u)) continue;
      const bool length = u.measure == Measure::length;
      return fmt::format("conflicting constraints: {} asks for a speed that the others forbid, by {:.4g} {}; {} among {}: {}",
                         numbering.describe(numbering.equation(u.slot)), std::abs(rate[static_cast<std::size_t>(m)]),
                         assembler_.model().units.label(length ? dimension::velocity : dimension::angular_velocity),
                         counted(one.redundant, "constraint") + " too many", names(assembler_, at_start_of_step(c), one.members),
                         cure_of(one));
    }
  return {};
}

ConstraintColumns Redundancy::columns_kind() const {
  const bool friction = std::any_of(mobility_.groups.begin(), mobility_.groups.end(), [&](const RedundantGroup& one) {
    return std::any_of(one.members.begin(), one.members.end(), [&](int m) { return has_friction(assembler_, m); });
  });
  return friction ? ConstraintColumns::gradients : ConstraintColumns::forces;
}

std::vector<Vector> Redundancy::undetermined(const Configuration& c) {
  // of entries of size 1 this remains where a projection should leave none, as of a held beam once its load has bent it
  constexpr double rounding = 1e-7;
  std::vector<Vector> changes;
  if (!active()) return changes;
  const ConstraintMatrix columns(assembler_, at_start_of_step(c), columns_kind());
  const Vector weight = constraint_sizes(assembler_) / assembler_.model().extent();
  Eigen::MatrixXd any(weight.size(), 2);
  for (Eigen::Index m = 0; m < any.rows(); ++m)
    for (Eigen::Index k = 0; k < any.cols(); ++k)
      any(m, k) =
          assembler_.idle(static_cast<int>(m)) ? 0 : std::cos(0.7 + 1.2 * static_cast<double>(k) + 2.3 * static_cast<double>(m));
  any -= least_alike(columns, weight, any);
  for (const auto& column : any.colwise()) {
    const Vector change = column.cwiseQuotient(weight);
    const double largest = change.lpNorm<Eigen::Infinity>();
    if (column.lpNorm<Eigen::Infinity>() > rounding) changes.push_back(change / largest);
  }
  return changes;
}

bool Redundancy::turn_flanks(const Configuration& here, const Vector& weight, const Vector& forces, Vector& least) const {
  const auto is_tooth = [&](int m) {
    return multiplier_of(assembler_.model(), assembler_.numbering().multiplier(m)).role == Role::tooth;
  };
  const auto any_tooth = [&](const RedundantGroup& one) { return std::any_of(one.members.begin(), one.members.end(), is_tooth); };
  if (std::none_of(mobility_.groups.begin(), mobility_.groups.end(), any_tooth)) return false;
  const Vector even = least_alike({assembler_, here, ConstraintColumns::gradients}, weight, forces);
  constexpr double significant = 1e-9;
  const double least_counted = significant * forces.lpNorm<Eigen::Infinity>();
  const auto turns = [&](int m) { return is_tooth(m) && even[m] * least[m] < 0 && std::abs(least[m]) > least_counted; };
  for (const RedundantGroup& one : mobility_.groups)
    if (std::any_of(one.members.begin(), one.members.end(), turns)) {
      least = even;
      return true;
    }
  return false;
}

bool Redundancy::share(Configuration& c, bool last) {
  if (!active()) return false;
  const Configuration here = at_start_of_step(c);
  const double extent = assembler_.model().extent();
  // forces count as they are, moments over the extent
  const Vector weight = constraint_sizes(assembler_) / extent;
  const Vector forces = Eigen::Map<const Vector>(c.multipliers.data(), weight.size()).cwiseProduct(weight);
  if (forces.isZero(0)) return false;
  Vector least = least_alike({assembler_, here, columns_kind()}, weight, forces);
  constexpr int most_turns = 4;
  turns_ = !last && turns_ < most_turns && turn_flanks(here, weight, forces, least) ? turns_ + 1 : 0;
  Configuration shared = here;
  Eigen::Map<Vector>(shared.multipliers.data(), weight.size()) = least.cwiseQuotient(weight);
  const Vector changed = change_of_forces(assembler_, here, shared);
  c.multipliers = std::move(shared.multipliers);
  assembler_.release(mobility_.dependent, c.multipliers);
  double largest = 0;
  for (int e = 0; e < assembler_.numbering().equations(); ++e) {
    const Unknown& u = assembler_.numbering().unknown(e);
    if (!u.multiplier) largest = std::max(largest, std::abs(changed[u.slot]) * size_of(u, extent) / extent);
  }
  return largest > 1e-11 * forces.lpNorm<Eigen::Infinity>();
}

}  // namespace engrane::solve
