// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "elements/structural/cell_book.hpp"
#include "elements/structural/cell_shapes.hpp"
#include "model/registry.hpp"

namespace engrane::elements::structural {

/// Shape functions of a face and their derivatives at a Gauss point.
struct FaceSample {
  double weight;
  std::vector<double> value;                 ///< one per node
  std::vector<std::array<double, 2>> slope;  ///< derivatives by the one or two coordinates of the face
};
/// Samples of an edge (2 or 3 nodes) or of a solid's face (3, 6, 4 or 8 nodes). Exact for pressure on a face wherever its
/// mid-side nodes are.
std::vector<FaceSample> face_samples(bool solid, std::size_t nodes);

/// Pressures on edges of plane cells (D = 2) or on faces of solids (D = 3). The force on node i is −p ∫ N_i n dA with n the
/// outward normal, consistent with the shape functions of the cell. With large displacements it follows the face (with the
/// initial thickness), and its tangent is not symmetric. A dead pressure keeps the forces of the reference configuration.
template <int D>
class Pressures final : public Block {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  explicit Pressures(std::size_t nodes) : samples_(face_samples(D == 3, nodes)) {
    layout_.nodes.assign(nodes, -1);
    layout_.needs.assign(nodes, D == 2 ? NodeNeed::in_plane : NodeNeed::translation);
  }

  struct Face {
    std::vector<int> nodes;  ///< corners, then mid-side nodes
    std::vector<Vector> places;
    double pressure = 0;  ///< positive against the normal given by the order of the nodes
    const Function* function = nullptr;
    bool dead = false;  ///< keeps normal and area of the reference configuration
    std::shared_ptr<const CellSection> section;

    bool follows() const { return !dead && !section->linear; }
  };

  std::size_t add(Face face) {
    faces_.push_back(std::move(face));
    return faces_.size() - 1;
  }

  std::size_t size() const override { return faces_.size(); }
  const Layout& layout() const override { return layout_; }
  std::span<const int> node_ids(std::size_t e) const override { return faces_[e].nodes; }
  bool in_mesh() const override { return false; }
  bool is_linear(std::size_t e) const override { return !faces_[e].follows(); }

  void residual(std::size_t first, std::span<const State> states, std::span<double> r) const override {
    const std::size_t n = width();
    for (std::size_t i = 0; i < states.size(); ++i) push(faces_[first + i], states[i], -1, r.subspan(i * n, n), {});
  }

  void tangent(std::size_t first, std::span<const State> states, Weights weights, std::span<double> r,
               std::span<double> k) const override {
    const std::size_t n = width();
    for (std::size_t i = 0; i < states.size(); ++i) {
      push(faces_[first + i], states[i], -1, r.subspan(i * n, n), k.subspan(i * n * n, n * n));
      for (double& entry : k.subspan(i * n * n, n * n)) entry *= weights.q;
    }
  }

  void constraint_rates(std::size_t, const State&, std::span<double>, std::span<double>, std::span<double>) const override {}

  Energies energies(std::size_t e, const State& state) const override {
    std::vector<double> forces(width());
    push(faces_[e], state, 1, forces, {});
    Energies energies;
    for (std::size_t i = 0; i < layout_.nodes.size(); ++i)
      energies.external += Eigen::Map<const Vector>(&forces[D * i]).dot(state.nodes[i].v.template head<D>());
    return energies;
  }

  bool applied(std::size_t e, const State& state, std::span<double> forces) const override {
    push(faces_[e], state, 1, forces, {});
    return true;
  }

 private:
  std::size_t width() const { return D * layout_.nodes.size(); }

  /// Writes `sign` times the forces to `f` and, unless `k` is empty, their derivative to `k`.
  void push(const Face& face, const State& state, double sign, std::span<double> f, std::span<double> k) const;

  Layout layout_;
  std::vector<FaceSample> samples_;
  std::vector<Face> faces_;
};

/// A pressure as given in a deck.
struct PressureOn {
  int cell = 0, face = 0;  ///< cell number; face or edge number, counted from 1
  double pressure = 0;     ///< positive against the outward normal
  const Function* function = nullptr;
  bool dead = false;  ///< keeps normal and area of the reference configuration
};

/// Builds the element of a pressure. Returns nullptr if there is no such face, which is reported at `keyword`, or if the cell
/// is invalid.
std::unique_ptr<Element> make_pressure(const PressureOn& pressure, int number, const char* keyword, const CellBook& book,
                                       BuildContext& context);

}  // namespace engrane::elements::structural
