// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/assembler.hpp"

#include <algorithm>
#include <cmath>

namespace engrane {

Assembler::Assembler(const Model& model, const Numbering& numbering, MPI_Comm comm)
    : model_(model), numbering_(numbering), comm_(comm) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &size_);
  const int n = numbering.equations();

  check_petsc(MatCreate(comm, matrix_.out()));
  check_petsc(MatSetSizes(matrix_, PETSC_DECIDE, PETSC_DECIDE, n, n));
  check_petsc(MatSetType(matrix_, MATAIJ));
  check_petsc(MatSetFromOptions(matrix_));
  check_petsc(MatSetUp(matrix_));
  check_petsc(MatCreateVecs(matrix_, nullptr, template_.out()));
  check_petsc(VecGetOwnershipRange(template_, &first_row_, &end_row_));

  // contiguous blocks of elements: neighbours in the deck are usually neighbours in the machine
  const auto parts = static_cast<long>(model.parts.size());
  const auto begin = static_cast<int>(parts * rank_ / size_), end = static_cast<int>(parts * (rank_ + 1) / size_);
  std::vector<PetscInt> coo_i, coo_j, rows;
  std::size_t widest = 0;
  for (int p = begin; p < end; ++p) {
    const auto& slots = numbering.part_slots(p);
    Share share{p, coo_i.size(), {}, rows.size(), {}, std::vector<double>(slots.size(), 1.0), std::vector<char>(slots.size(), 1)};
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const int row = numbering.equation(slots[i]);
      if (row < 0) continue;
      share.rows.push_back(i);
      rows.push_back(row);
      for (std::size_t j = 0; j < slots.size(); ++j) {
        const int column = numbering.equation(slots[j]);
        if (column < 0) continue;
        share.entries.push_back(i * slots.size() + j);
        coo_i.push_back(row);
        coo_j.push_back(column);
      }
    }
    widest = std::max(widest, slots.size());
    shares_.push_back(std::move(share));
  }
  // every diagonal entry exists: factorisations expect it, projections write it
  diagonal_begin_ = coo_i.size();
  for (PetscInt row = first_row_; row < end_row_; ++row) {
    coo_i.push_back(row);
    coo_j.push_back(row);
  }
  check_petsc(MatSetPreallocationCOO(matrix_, static_cast<PetscCount>(coo_i.size()), coo_i.data(), coo_j.data()));
  check_petsc(VecSetPreallocationCOO(template_, static_cast<PetscCount>(rows.size()), rows.data()));
  coo_values_.assign(coo_i.size(), 0);
  row_values_.assign(rows.size(), 0);
  local_r_.resize(widest);
  local_k_.resize(widest * widest);
  local_mass_.resize(widest * widest);

  const auto multipliers = static_cast<std::size_t>(numbering.slots() - numbering.motion_slots());
  scale_.assign(multipliers, 1.0);
  released_.assign(multipliers, false);
  released_values_.assign(multipliers, 0.0);
  if (size_ > 1) check_petsc(VecScatterCreateToAll(template_, scatter_.out(), everywhere_.out()));
}

Vec Assembler::new_vector() const {
  Vec v = nullptr;
  check_petsc(VecDuplicate(template_, &v));
  return v;
}

State Assembler::view(int part, const Configuration& c) {
  const Model::Part& p = model_.parts[static_cast<std::size_t>(part)];
  const Layout& layout = p.element->layout();
  local_nodes_.resize(p.nodes.size());
  for (std::size_t i = 0; i < p.nodes.size(); ++i) local_nodes_[i] = c.nodes[static_cast<std::size_t>(p.nodes[i])];
  const auto piece = [](const std::vector<double>& all, int begin, std::size_t count) {
    return std::span(all).subspan(static_cast<std::size_t>(begin), count);
  };
  State s;
  s.nodes = local_nodes_;
  s.scalars = piece(c.scalars, numbering_.scalar_begin(part), layout.scalars.size());
  s.scalar_rates = piece(c.scalar_rates, numbering_.scalar_begin(part), layout.scalars.size());
  s.scalar_accelerations = piece(c.scalar_accelerations, numbering_.scalar_begin(part), layout.scalars.size());
  s.multipliers = piece(c.multipliers, numbering_.multiplier_begin(part), layout.multipliers.size());
  s.history = piece(c.history, numbering_.history_begin(part), static_cast<std::size_t>(layout.history));
  s.time = c.time;
  s.gravity = model_.gravity_at(c.time);
  s.penalty = penalty;
  s.contact_homotopy = contact_homotopy;
  return s;
}

void Assembler::commit(Configuration& configuration) {
  std::vector<double> history = configuration.history;
  for (std::size_t p = 0; p < model_.parts.size(); ++p) {
    const Layout& layout = model_.parts[p].element->layout();
    if (layout.history == 0) continue;
    const int part = static_cast<int>(p);
    model_.parts[p].element->commit(
        view(part, configuration),
        std::span(configuration.scalars).subspan(static_cast<std::size_t>(numbering_.scalar_begin(part)), layout.scalars.size()),
        std::span(history).subspan(static_cast<std::size_t>(numbering_.history_begin(part)),
                                   static_cast<std::size_t>(layout.history)));
  }
  configuration.history = std::move(history);
}

void Assembler::update_factors() {
  for (Share& share : shares_) {
    const Layout& layout = model_.parts[static_cast<std::size_t>(share.part)].element->layout();
    const std::size_t first = share.factor.size() - layout.multipliers.size();
    for (std::size_t i = 0; i < layout.multipliers.size(); ++i)
      share.factor[first + i] = scale_[static_cast<std::size_t>(numbering_.multiplier_begin(share.part)) + i];
  }
}

void Assembler::release(const std::vector<int>& multipliers, const std::vector<double>& values) {
  any_released_ = !multipliers.empty();
  std::fill(released_.begin(), released_.end(), false);
  for (const int m : multipliers) {
    released_[static_cast<std::size_t>(m)] = true;
    released_values_[static_cast<std::size_t>(m)] = values[static_cast<std::size_t>(m)];
  }
  for (Share& share : shares_) {
    const auto& slots = numbering_.part_slots(share.part);
    for (std::size_t i = 0; i < slots.size(); ++i)
      share.kept[i] = slots[i] < numbering_.motion_slots() || !released(slots[i] - numbering_.motion_slots());
  }
}

void Assembler::save(Snapshot& snapshot) const {
  snapshot.put("assembler/scale", scale_);
  snapshot.put("assembler/released", {released_.begin(), released_.end()});
  snapshot.put("assembler/released_values", released_values_);
}

void Assembler::load(const Snapshot& snapshot) {
  const std::vector<double>& scale = snapshot.array("assembler/scale");
  const std::vector<double>& flags = snapshot.array("assembler/released");
  if (scale.size() != scale_.size() || flags.size() != scale_.size())
    throw std::out_of_range("the restart point has another number of constraints");
  std::vector<int> multipliers;
  for (std::size_t m = 0; m < flags.size(); ++m)
    if (flags[m] != 0) multipliers.push_back(static_cast<int>(m));
  release(multipliers, snapshot.array("assembler/released_values"));
  scale_ = scale;
  update_factors();
}

bool Assembler::released_equation(int equation) const {
  const Unknown& u = numbering_.unknown(equation);
  return u.multiplier && released(u.slot - numbering_.motion_slots());
}

void Assembler::choose_scale(const Configuration& configuration, Weights weights, double fixed) {
  if (fixed > 0) {
    std::fill(scale_.begin(), scale_.end(), fixed);
    update_factors();
    return;
  }
  const auto motion = static_cast<std::size_t>(numbering_.motion_slots());
  std::vector<double> diagonal(motion, 0.0);
  const auto for_each_tangent = [&](auto&& use) {
    for (const Share& share : shares_) {
      const Element& element = *model_.parts[static_cast<std::size_t>(share.part)].element;
      const auto& slots = numbering_.part_slots(share.part);
      const std::size_t n = slots.size();
      element.tangent(view(share.part, configuration), weights, std::span(local_r_).first(n), std::span(local_k_).first(n * n));
      use(share, slots, n);
    }
  };
  for_each_tangent([&](const Share&, const std::vector<int>& slots, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i)
      if (const auto slot = static_cast<std::size_t>(slots[i]); slot < motion) diagonal[slot] += local_k_[i * n + i];
  });
  MPI_Allreduce(MPI_IN_PLACE, diagonal.data(), static_cast<int>(motion), MPI_DOUBLE, MPI_SUM, comm_);

  std::vector<double> k(scale_.size(), 0.0);
  for_each_tangent([&](const Share& share, const std::vector<int>& slots, std::size_t n) {
    for (std::size_t i = n - model_.parts[static_cast<std::size_t>(share.part)].element->layout().multipliers.size(); i < n;
         ++i) {
      double steepest = 0;
      for (std::size_t j = 0; j < n; ++j) steepest = std::max(steepest, std::abs(local_k_[i * n + j]));
      double size = 0;
      for (std::size_t j = 0; j < n; ++j) {
        const auto slot = static_cast<std::size_t>(slots[j]);
        const double b = std::abs(local_k_[i * n + j]) / std::max(std::abs(weights.q), 1e-300);
        // a slot that the constraint hardly touches says nothing about the size of its forces
        if (slot < motion && numbering_.equation(slots[j]) >= 0 && b > 1e-6 * steepest)
          size = std::max(size, std::abs(diagonal[slot]) / b);
      }
      k[static_cast<std::size_t>(slots[i]) - motion] = size;
    }
  });
  MPI_Allreduce(MPI_IN_PLACE, k.data(), static_cast<int>(k.size()), MPI_DOUBLE, MPI_MAX, comm_);
  // constraints between things without mass and stiffness borrow the largest scale of the others
  const double largest = k.empty() ? 1.0 : *std::max_element(k.begin(), k.end());
  for (std::size_t i = 0; i < k.size(); ++i) scale_[i] = k[i] > 0 ? k[i] : largest > 0 ? largest : 1.0;
  update_factors();
}

Magnitudes Assembler::residual(const Configuration& configuration, Vec r) {
  Magnitudes largest;
  for (const Share& share : shares_) {
    const Element& element = *model_.parts[static_cast<std::size_t>(share.part)].element;
    const auto& slots = numbering_.part_slots(share.part);
    element.residual(view(share.part, configuration), std::span(local_r_).first(slots.size()));
    for (std::size_t e = 0; e < share.rows.size(); ++e) {
      const std::size_t i = share.rows[e];
      if (!share.kept[i]) {
        const int m = slots[i] - numbering_.motion_slots();
        local_r_[i] = (released_value(m) - configuration.multipliers[static_cast<std::size_t>(m)]) / share.factor[i];
      }
      row_values_[share.row_begin + e] = local_r_[i] * share.factor[i];
      double& size = largest[numbering_.unknown(numbering_.equation(slots[i])).measure];
      size = std::max(size, std::abs(local_r_[i]));
    }
  }
  // the COO pattern of a vector does not survive VecDuplicate: assemble in the template, hand over a copy
  check_petsc(VecSetValuesCOO(template_, row_values_.data(), INSERT_VALUES));
  check_petsc(VecCopy(template_, r));
  if (size_ > 1) MPI_Allreduce(MPI_IN_PLACE, largest.of, 4, MPI_DOUBLE, MPI_MAX, comm_);
  return largest;
}

void Assembler::add_entries(const Share& share, std::span<const double> k) {
  const std::size_t n = share.factor.size();
  for (std::size_t e = 0; e < share.entries.size(); ++e) {
    const std::size_t at = share.entries[e];
    coo_values_[share.coo_begin + e] = share.kept[at / n] ? k[at] * share.factor[at / n] * share.factor[at % n] : 0.0;
  }
}

void Assembler::set_matrix_values() { check_petsc(MatSetValuesCOO(matrix_, coo_values_.data(), INSERT_VALUES)); }

void Assembler::tangent(const Configuration& configuration, Weights weights) {
  for (const Share& share : shares_) {
    const Element& element = *model_.parts[static_cast<std::size_t>(share.part)].element;
    const std::size_t n = share.factor.size();
    element.tangent(view(share.part, configuration), weights, std::span(local_r_).first(n), std::span(local_k_).first(n * n));
    add_entries(share, local_k_);
  }
  std::fill(coo_values_.begin() + static_cast<long>(diagonal_begin_), coo_values_.end(), 0.0);
  for (PetscInt row = first_row_; any_released_ && row < end_row_; ++row)
    if (released_equation(static_cast<int>(row)))
      coo_values_[diagonal_begin_ + static_cast<std::size_t>(row - first_row_)] =
          -scale_[static_cast<std::size_t>(numbering_.unknown(static_cast<int>(row)).slot - numbering_.motion_slots())];
  set_matrix_values();
}

void Assembler::projection(const Configuration& configuration, Metric metric, std::span<const int> held) {
  const bool mass = metric != Metric::geometric;
  const auto motion = static_cast<std::size_t>(numbering_.motion_slots());
  std::vector<double> inertia(motion, 0.0);
  for (const Share& share : shares_) {
    const Element& element = *model_.parts[static_cast<std::size_t>(share.part)].element;
    const Layout& layout = element.layout();
    const auto& slots = numbering_.part_slots(share.part);
    const std::size_t n = slots.size(), m0 = n - layout.multipliers.size();
    element.tangent(view(share.part, configuration), {1, 0, 0}, std::span(local_r_).first(n), std::span(local_k_).first(n * n));
    if (mass)
      element.tangent(view(share.part, configuration), {0, 0, 1}, std::span(local_r_).first(n),
                      std::span(local_mass_).first(n * n));
    for (std::size_t i = 0; i < m0; ++i)
      for (std::size_t j = 0; j < m0; ++j) local_k_[i * n + j] = mass ? local_mass_[i * n + j] : 0.0;
    for (std::size_t i = 0; i < m0; ++i) {
      inertia[static_cast<std::size_t>(slots[i])] += local_k_[i * n + i];
      // a multiplier's column may hold more than −Bᵀ (the separating force of gears): a projection wants −Bᵀ alone
      if (metric == Metric::dynamic) continue;
      for (std::size_t j = m0; j < n; ++j) local_k_[i * n + j] = local_k_[j * n + i];
    }
    for (std::size_t e = 0; e < share.entries.size(); ++e)
      coo_values_[share.coo_begin + e] = share.kept[share.entries[e] / n] ? local_k_[share.entries[e]] : 0.0;
  }
  MPI_Allreduce(MPI_IN_PLACE, inertia.data(), static_cast<int>(motion), MPI_DOUBLE, MPI_SUM, comm_);
  double largest = 0;
  for (const double d : inertia) largest = std::max(largest, d);
  const double extent = model_.extent();
  for (PetscInt row = first_row_; row < end_row_; ++row) {
    const Unknown& u = numbering_.unknown(static_cast<int>(row));
    double d = any_released_ && released_equation(static_cast<int>(row)) ? 1.0 : 0.0;
    if (!u.multiplier && !mass) d = u.part >= 0 ? 1e-12 : u.measure == Measure::force ? 1 / (extent * extent) : 1.0;
    if (!u.multiplier && mass && inertia[static_cast<std::size_t>(u.slot)] == 0) d = 1e-13 * (largest > 0 ? largest : 1.0);
    if (std::find(held.begin(), held.end(), static_cast<int>(row)) != held.end()) d = 1e8 * std::max(largest, 1.0);
    coo_values_[diagonal_begin_ + static_cast<std::size_t>(row - first_row_)] = d;
  }
  set_matrix_values();
}

void Assembler::constraint_rates(const Configuration& configuration, std::vector<double>& phi, std::vector<double>& rate,
                                 std::vector<double>& second) {
  phi.assign(scale_.size(), 0);
  rate = second = phi;
  // every rank does all: it happens a few times at the start, and saves a reduction
  for (std::size_t p = 0; p < model_.parts.size(); ++p) {
    const int part = static_cast<int>(p);
    const std::size_t count = model_.parts[p].element->layout().multipliers.size();
    const auto begin = static_cast<std::size_t>(numbering_.multiplier_begin(part));
    model_.parts[p].element->constraint_rates(view(part, configuration), std::span(phi).subspan(begin, count),
                                              std::span(rate).subspan(begin, count), std::span(second).subspan(begin, count));
  }
}

std::vector<double> Assembler::slot_residual(const Configuration& configuration) {
  std::vector<double> all(static_cast<std::size_t>(numbering_.slots()), 0.0);
  std::vector<double> r;
  for (std::size_t p = 0; p < model_.parts.size(); ++p) {
    const auto& slots = numbering_.part_slots(static_cast<int>(p));
    r.resize(slots.size());
    model_.parts[p].element->residual(view(static_cast<int>(p), configuration), r);
    for (std::size_t i = 0; i < slots.size(); ++i) all[static_cast<std::size_t>(slots[i])] += r[i];
  }
  return all;
}

std::span<const double> Assembler::gather(Vec x) {
  gathered_.resize(static_cast<std::size_t>(numbering_.equations()));
  Vec source = x;
  if (size_ > 1) {
    check_petsc(VecScatterBegin(scatter_, x, everywhere_, INSERT_VALUES, SCATTER_FORWARD));
    check_petsc(VecScatterEnd(scatter_, x, everywhere_, INSERT_VALUES, SCATTER_FORWARD));
    source = everywhere_;
  }
  const PetscScalar* values = nullptr;
  check_petsc(VecGetArrayRead(source, &values));
  std::copy_n(values, gathered_.size(), gathered_.begin());
  check_petsc(VecRestoreArrayRead(source, &values));
  return gathered_;
}

void Assembler::spread(std::span<const double> all, Vec x) const {
  PetscScalar* values = nullptr;
  check_petsc(VecGetArrayWrite(x, &values));
  for (PetscInt row = first_row_; row < end_row_; ++row) values[row - first_row_] = all[static_cast<std::size_t>(row)];
  check_petsc(VecRestoreArrayWrite(x, &values));
}

}  // namespace engrane
