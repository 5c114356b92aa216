// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <typeindex>
#include <utility>

#include "model/element.hpp"

namespace engrane {

/// Many elements of one kind with the same options. Common data (layout, names) is stored once; individual data (nodes,
/// parameters) is in arrays of the block. The assembly evaluates ranges of consecutive elements; all other code sees each
/// element as an Element (BlockMember).
///
/// `first` and `e` number the elements of the block from 0. See Element for the meaning of the functions.
class Block {
 public:
  Block() = default;
  virtual ~Block() = default;
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  virtual std::size_t size() const = 0;
  /// Common to all elements. Its `nodes` are 0 for the ground and −1 for any other node.
  virtual const Layout& layout() const = 0;
  virtual std::span<const int> node_ids(std::size_t e) const = 0;

  /// Residuals, and tangents, of states.size() consecutive elements, one after the other.
  virtual void residual(std::size_t first, std::span<const State> states, std::span<double> r) const = 0;
  virtual void tangent(std::size_t first, std::span<const State> states, Weights weights, std::span<double> r,
                       std::span<double> k) const = 0;
  virtual void constraint_rates(std::size_t e, const State& state, std::span<double> phi, std::span<double> rate,
                                std::span<double> second) const = 0;

  virtual void start(std::size_t e, std::span<double> scalars, std::span<double> history) const;
  virtual void count_turns(std::size_t e, const State& state, std::span<double> scalars, std::span<double> history) const;
  virtual void commit(std::size_t e, const State& state, std::span<double> scalars, std::span<double> history) const;

  virtual Energies energies(std::size_t e, const State& state) const;
  virtual bool applied(std::size_t /*e*/, const State& /*state*/, std::span<double> /*forces*/) const { return false; }
  virtual CellShape cell_shape() const { return CellShape::none; }
  virtual bool keeps_shape() const { return false; }
  virtual bool sees_remainders() const { return false; }
  virtual bool in_mesh() const { return true; }
  virtual bool is_body() const { return false; }
  virtual bool is_linear(std::size_t) const { return false; }
  virtual const char* why_not_finite() const { return ""; }
  virtual Mat3 inertia_at(std::size_t e, int node) const;
  virtual const std::vector<Channel>& channels() const;
  virtual void observe(std::size_t e, const State& state, std::span<double> values) const;
  virtual const std::vector<Field>& fields() const;
  virtual void evaluate_fields(std::size_t e, const State& state, std::span<double> values) const;
  virtual int section(std::size_t) const { return -1; }
  virtual const Eigen::MatrixXd* extrapolation() const { return nullptr; }
  virtual StressEnergies stress_energies(std::size_t /*e*/, const State& /*state*/, std::span<const double> /*at_nodes*/) const {
    return {};
  }
  virtual std::vector<Derived> derived(std::size_t e) const;
  virtual Drawing drawing(std::size_t e) const;
};

/// One element of a block.
class BlockMember final : public Element {
 public:
  BlockMember(int id, std::shared_ptr<const Block> block, std::size_t index)
      : Element(id), block_(std::move(block)), index_(index) {}

  const Block& block() const { return *block_; }
  std::size_t index() const { return index_; }

  const Layout& layout() const override { return block_->layout(); }
  std::span<const int> node_ids() const override { return block_->node_ids(index_); }
  void residual(const State& state, std::span<double> r) const override { block_->residual(index_, {&state, 1}, r); }
  void tangent(const State& state, Weights weights, std::span<double> r, std::span<double> k) const override {
    block_->tangent(index_, {&state, 1}, weights, r, k);
  }
  void constraint_rates(const State& state, std::span<double> phi, std::span<double> rate,
                        std::span<double> second) const override {
    block_->constraint_rates(index_, state, phi, rate, second);
  }
  void start(std::span<double> scalars, std::span<double> history) const override { block_->start(index_, scalars, history); }
  void count_turns(const State& state, std::span<double> scalars, std::span<double> history) const override {
    block_->count_turns(index_, state, scalars, history);
  }
  void commit(const State& state, std::span<double> scalars, std::span<double> history) const override {
    block_->commit(index_, state, scalars, history);
  }
  Energies energies(const State& state) const override { return block_->energies(index_, state); }
  bool applied(const State& state, std::span<double> forces) const override { return block_->applied(index_, state, forces); }
  CellShape cell_shape() const override { return block_->cell_shape(); }
  bool keeps_shape() const override { return block_->keeps_shape(); }
  bool sees_remainders() const override { return block_->sees_remainders(); }
  bool in_mesh() const override { return block_->in_mesh(); }
  bool is_body() const override { return block_->is_body(); }
  bool is_linear() const override { return block_->is_linear(index_); }
  const char* why_not_finite() const override { return block_->why_not_finite(); }
  Mat3 inertia_at(int node) const override { return block_->inertia_at(index_, node); }
  const std::vector<Channel>& channels() const override { return block_->channels(); }
  void observe(const State& state, std::span<double> values) const override { block_->observe(index_, state, values); }
  const std::vector<Field>& fields() const override { return block_->fields(); }
  void evaluate_fields(const State& state, std::span<double> values) const override {
    block_->evaluate_fields(index_, state, values);
  }
  int section() const override { return block_->section(index_); }
  const Eigen::MatrixXd* extrapolation() const override { return block_->extrapolation(); }
  StressEnergies stress_energies(const State& state, std::span<const double> at_nodes) const override {
    return block_->stress_energies(index_, state, at_nodes);
  }
  std::vector<Derived> derived() const override { return block_->derived(index_); }
  Drawing drawing() const override { return block_->drawing(index_); }

 private:
  std::shared_ptr<const Block> block_;
  std::size_t index_;
};

/// A range of consecutive elements of a block, or a single element: the unit of evaluation.
class ElementRange {
 public:
  explicit ElementRange(const Element& element) : element_(&element) {
    if (const auto* member = dynamic_cast<const BlockMember*>(&element)) {
      block_ = &member->block();
      first_ = member->index();
    }
  }

  /// Appends `element` if it is the next one of the block; otherwise returns false.
  bool extend(const Element& element) {
    const ElementRange next(element);
    if (!block_ || next.block_ != block_ || next.first_ != first_ + count_) return false;
    ++count_;
    return true;
  }

  std::size_t count() const { return count_; }
  void residual(std::span<const State> states, std::span<double> r) const {
    if (block_)
      block_->residual(first_, states, r);
    else
      element_->residual(states[0], r);
  }
  void tangent(std::span<const State> states, Weights weights, std::span<double> r, std::span<double> k) const {
    if (block_)
      block_->tangent(first_, states, weights, r, k);
    else
      element_->tangent(states[0], weights, r, k);
  }

 private:
  const Element* element_;
  const Block* block_ = nullptr;
  std::size_t first_ = 0, count_ = 1;
};

/// The blocks of a model under construction.
class BlockStore {
 public:
  /// Returns the block of type B with these options, constructed from `arguments` on first use. Elements of one type belong to
  /// different blocks if their `options` differ.
  template <class B, class... Arguments>
  std::shared_ptr<B> block(const std::string& options, Arguments&&... arguments) {
    std::shared_ptr<Block>& found = blocks_[{std::type_index(typeid(B)), options}];
    if (!found) found = std::make_shared<B>(std::forward<Arguments>(arguments)...);
    return std::static_pointer_cast<B>(found);
  }

 private:
  std::map<std::pair<std::type_index, std::string>, std::shared_ptr<Block>> blocks_;
};

}  // namespace engrane
