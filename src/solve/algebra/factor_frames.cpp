// SPDX-License-Identifier: BSD-3-Clause
#include "solve/algebra/factor_frames.hpp"

#include <algorithm>
#include <map>
#include <span>

namespace engrane::solve {

namespace {

/// If no node has turned by more than this since the tangent was made (in radians, about), the comparison says little.
constexpr double least_turn = 0.02;
constexpr int longest_pause = 64;

/// A row of a matrix, for the lifetime of this object.
class Row {
 public:
  Row(Mat matrix, int row) : matrix_(matrix), row_(row) { check_petsc(MatGetRow(matrix, row, &size_, &columns_, &values_)); }
  ~Row() { (void)MatRestoreRow(matrix_, row_, &size_, &columns_, &values_); }
  Row(const Row&) = delete;
  Row& operator=(const Row&) = delete;

  std::span<const PetscInt> columns() const { return {columns_, static_cast<std::size_t>(size_)}; }
  std::span<const PetscScalar> values() const { return {values_, static_cast<std::size_t>(size_)}; }

 private:
  Mat matrix_;
  PetscInt row_, size_ = 0;
  const PetscInt* columns_ = nullptr;
  const PetscScalar* values_ = nullptr;
};

/// Whether a joint's multipliers from `m` on are the three components of a vector.
bool is_vector(const std::vector<Multiplier>& multipliers, std::size_t m) {
  if (m + 3 > multipliers.size()) return false;
  const Role role = multipliers[m].role;
  return (role == Role::force || role == Role::moment) && multipliers[m + 1].role == role && multipliers[m + 2].role == role;
}

}  // namespace

FactorFrames::FactorFrames(const Assembler& assembler) {
  int ranks = 1;
  MPI_Comm_size(assembler.comm(), &ranks);
  if (ranks > 1) return;
  const Numbering& numbering = assembler.numbering();
  frame_of_.assign(static_cast<std::size_t>(numbering.equations()), -1);
  const auto from = [&](int slot) {
    return std::array{numbering.equation(slot), numbering.equation(slot + 1), numbering.equation(slot + 2)};
  };
  for (int node = 0; node < static_cast<int>(assembler.model().nodes.size()); ++node) add(node, from(6 * node + 3));
  for (int p = 0; p < numbering.parts(); ++p) {
    const Model::Part& part = assembler.model().parts[static_cast<std::size_t>(p)];
    if (part.element->layout().shares_multipliers) continue;
    const auto& multipliers = part.element->layout().multipliers;
    const int slot = numbering.motion_slots() + numbering.multiplier_begin(p);
    for (std::size_t m = 0; m < multipliers.size(); m += is_vector(multipliers, m) ? 3 : 1)
      if (is_vector(multipliers, m)) add(part.nodes.front(), from(slot + static_cast<int>(m)));
  }
}

void FactorFrames::add(int node, const std::array<int, 3>& equations) {
  if (node == 0 || std::any_of(equations.begin(), equations.end(), [](int e) { return e < 0; })) return;
  for (const int e : equations) frame_of_[static_cast<std::size_t>(e)] = static_cast<int>(frames_.size());
  frames_.push_back({node, equations});
}

void FactorFrames::take_old(const Configuration& c, Mat tangent, bool comparable) {
  old_.clear();
  bool moved = false;
  for (Frame& frame : frames_) {
    frame.q = c.nodes[static_cast<std::size_t>(frame.node)].R.transpose() * frame.made_for;
    moved = moved || (frame.q - Mat3::Identity()).norm() > least_turn;
  }
  if (!comparable || !moved || --left_ > 0) return;
  for (const Frame& frame : frames_)
    for (const int equation : frame.equations) {
      const Row row(tangent, equation);
      old_.insert(old_.end(), row.values().begin(), row.values().end());
    }
}

void FactorFrames::measure(Mat tangent, const std::function<double(int)>& length) {
  couplings_.clear();
  for (Frame& frame : frames_) frame.couplings.clear();
  std::size_t place = 0;
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    Frame& frame = frames_[f];
    std::map<int, std::array<Mat3, 2>> triples;  // before and now, by the frame of the columns
    std::map<int, std::array<Vec3, 2>> others;   // by the column
    for (int r = 0; r < 3; ++r) {
      const int equation = frame.equations[static_cast<std::size_t>(r)];
      const Row row(tangent, equation);
      for (std::size_t k = 0; k < row.columns().size(); ++k, ++place) {
        const int column = row.columns()[k];
        const double size = length(equation) * length(column);
        const std::array values{old_[place] * size, row.values()[k] * size};
        const int other = frame_of_[static_cast<std::size_t>(column)];
        if (other < 0) {
          auto& both = others.try_emplace(column, std::array<Vec3, 2>{Vec3::Zero(), Vec3::Zero()}).first->second;
          for (std::size_t i = 0; i < 2; ++i) both[i][r] = values[i];
          continue;
        }
        const auto& equations = frames_[static_cast<std::size_t>(other)].equations;
        const auto at = std::find(equations.begin(), equations.end(), column) - equations.begin();
        auto& both = triples.try_emplace(other, std::array<Mat3, 2>{Mat3::Zero(), Mat3::Zero()}).first->second;
        for (std::size_t i = 0; i < 2; ++i) both[i](r, at) = values[i];
      }
    }
    frame.alone = {};
    for (const auto& [column, both] : others) {
      frame.alone[0] += (both[1] - both[0]).squaredNorm();
      frame.alone[1] += (both[1] - frame.q * both[0]).squaredNorm();
    }
    for (const auto& [other, both] : triples) {
      const auto column = static_cast<std::size_t>(other);
      Coupling coupling{f, column};
      const Mat3 back = frames_[column].q.transpose();
      coupling.misfit[0] = {(both[1] - both[0]).squaredNorm(), (both[1] - both[0] * back).squaredNorm()};
      coupling.misfit[1] = {(both[1] - frame.q * both[0]).squaredNorm(), (both[1] - frame.q * both[0] * back).squaredNorm()};
      frame.couplings.push_back(couplings_.size());
      if (column != f) frames_[column].couplings.push_back(couplings_.size());
      couplings_.push_back(coupling);
    }
  }
}

double FactorFrames::misfit(const std::vector<char>& turned, std::size_t frame) const {
  double sum = frames_[frame].alone[static_cast<std::size_t>(turned[frame])];
  for (const std::size_t k : frames_[frame].couplings) {
    const Coupling& coupling = couplings_[k];
    sum += coupling.misfit[static_cast<std::size_t>(turned[coupling.row])][static_cast<std::size_t>(turned[coupling.column])];
  }
  return sum;
}

double FactorFrames::settle(std::vector<char>& turned) const {
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      const double before = misfit(turned, f);
      turned[f] = turned[f] == 0 ? 1 : 0;
      if (misfit(turned, f) < before)
        changed = true;
      else
        turned[f] = turned[f] == 0 ? 1 : 0;
    }
  }
  double sum = 0;
  for (std::size_t f = 0; f < frames_.size(); ++f) sum += misfit(turned, f);
  return sum;
}

void FactorFrames::renew(const Configuration& c, Mat tangent, const std::function<double(int)>& length) {
  if (!old_.empty()) {
    measure(tangent, length);
    std::vector<char> best(frames_.size(), 1), other(frames_.size(), 0);
    if (!(settle(best) < settle(other))) best = other;
    bool changed = false;
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      changed = changed || frames_[f].turned != (best[f] != 0);
      frames_[f].turned = best[f] != 0;
    }
    pause_ = changed ? 1 : std::min(2 * pause_, longest_pause);
    left_ = pause_;
  }
  for (Frame& frame : frames_) frame.made_for = c.nodes[static_cast<std::size_t>(frame.node)].R;
}

template <class Turn>
void FactorFrames::apply(Vec v, const Turn& turn) const {
  PetscScalar* values = nullptr;
  check_petsc(VecGetArray(v, &values));
  for (const Frame& frame : frames_) {
    if (!frame.turned) continue;
    const auto [x, y, z] = frame.equations;
    const Vec3 part = turn(frame.q, Vec3(values[x], values[y], values[z]));
    values[x] = part[0];
    values[y] = part[1];
    values[z] = part[2];
  }
  check_petsc(VecRestoreArray(v, &values));
}

void FactorFrames::turn_right_side(const Configuration& c, Vec v) {
  for (Frame& frame : frames_)
    if (frame.turned) frame.q = c.nodes[static_cast<std::size_t>(frame.node)].R.transpose() * frame.made_for;
  apply(v, [](const Mat3& q, const Vec3& part) -> Vec3 { return q.transpose() * part; });
}

void FactorFrames::turn_solution(Vec v) const {
  apply(v, [](const Mat3& q, const Vec3& part) -> Vec3 { return q * part; });
}

void FactorFrames::save(Snapshot& snapshot) const {
  std::vector<double> all{static_cast<double>(pause_), static_cast<double>(left_)};
  for (const Frame& frame : frames_) {
    all.push_back(frame.turned ? 1 : 0);
    all.insert(all.end(), frame.made_for.data(), frame.made_for.data() + 9);
  }
  snapshot.put("newton/frames", std::move(all));
}

void FactorFrames::load(const Snapshot& snapshot) {
  const std::vector<double>& all = snapshot.array("newton/frames");
  if (all.size() != 2 + 10 * frames_.size()) return;  // this run or the earlier one has several ranks
  pause_ = static_cast<int>(all[0]);
  left_ = static_cast<int>(all[1]);
  for (std::size_t f = 0; f < frames_.size(); ++f) {
    frames_[f].turned = all[2 + 10 * f] != 0;
    std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(3 + 10 * f), 9, frames_[f].made_for.data());
  }
}

}  // namespace engrane::solve
