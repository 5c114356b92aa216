// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "model/block.hpp"
#include "model/sweep.hpp"

namespace engrane {

/// Block of elements with one templated residual, as in TemplatedElement. `Data` holds the data of one element and has
///
///     template <class T> void evaluate(const Motion<T, Nodes>&, const State&, Balance<T, Nodes>&) const;
///
/// A derived block adds the other results of its elements, from data(e).
template <class Data, int Nodes, int Lanes>
class TemplatedBlock : public Block {
 public:
  using Ids = std::array<int, static_cast<std::size_t>(Nodes)>;

  explicit TemplatedBlock(Layout layout) : sweep_(std::move(layout)) {}

  /// Adds an element to `block`.
  static std::unique_ptr<Element> add(const std::shared_ptr<TemplatedBlock>& block, int id, const Ids& nodes, Data data) {
    block->nodes_.push_back(nodes);
    block->data_.push_back(std::move(data));
    return std::make_unique<BlockMember>(id, block, block->data_.size() - 1);
  }

  /// Reserves memory for a known number of elements.
  void reserve(std::size_t count) {
    nodes_.reserve(count);
    data_.reserve(count);
  }

  std::size_t size() const final { return data_.size(); }
  const Layout& layout() const final { return sweep_.layout(); }
  std::span<const int> node_ids(std::size_t e) const final { return nodes_[e]; }

  void residual(std::size_t first, std::span<const State> states, std::span<double> r) const final {
    const std::size_t n = sweep_.slots();
    for (std::size_t i = 0; i < states.size(); ++i)
      sweep_.residual(states[i], r.subspan(i * n, n), evaluation(first + i, states[i]));
  }

  void tangent(std::size_t first, std::span<const State> states, Weights weights, std::span<double> r,
               std::span<double> k) const override {
    const std::size_t n = sweep_.slots();
    for (std::size_t i = 0; i < states.size(); ++i)
      sweep_.tangent(states[i], weights, r.subspan(i * n, n), k.subspan(i * n * n, n * n), evaluation(first + i, states[i]));
  }

  void constraint_rates(std::size_t e, const State& state, std::span<double> phi, std::span<double> rate,
                        std::span<double> second) const final {
    sweep_.constraint_rates(state, phi, rate, second, evaluation(e, state));
  }

 protected:
  const Data& data(std::size_t e) const { return data_[e]; }

 private:
  auto evaluation(std::size_t e, const State& state) const {
    return [&data = data_[e], &state](const auto& motion, auto& balance) { data.evaluate(motion, state, balance); };
  }

  Sweep<Nodes, Lanes> sweep_;
  std::vector<Ids> nodes_;
  std::vector<Data> data_;
};

}  // namespace engrane
