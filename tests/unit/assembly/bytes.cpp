// SPDX-License-Identifier: BSD-3-Clause
// What an element of a block costs beyond its physical data, counted byte by byte.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "springs.hpp"

namespace {
std::atomic<std::size_t> allocated = 0;
}

// every allocation of this binary is counted by the size asked for; PETSc's own arrays do not come from here
void* operator new(std::size_t size) {
  allocated += size;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace engrane::test {
namespace {

TEST(Block, AnElementCostsLittleBeyondItsData) {
  constexpr int n = 20000;
  Model model;
  for (int i = 0; i <= n; ++i) model.nodes.push_back({i, Vec3(i, 0, 0)});
  const auto springs = std::make_shared<Springs>(spring_layout(-1, -1));
  std::vector<std::unique_ptr<Element>> elements;
  elements.reserve(n);
  // what growing arrays leave behind is not kept: their final size is known
  springs->reserve(n);
  const std::size_t before = allocated;
  for (int i = 1; i < n; ++i) elements.push_back(Springs::add(springs, i, {i, i + 1}, {10, 1}));
  const double of_elements = static_cast<double>(allocated - before) / n + sizeof(SpringData) + 2 * sizeof(int) + sizeof(void*);
  for (auto& element : elements) {
    Model::Part part;
    for (const int id : element->node_ids()) part.nodes.push_back(id);
    part.element = std::move(element);
    model.parts.push_back(std::move(part));
  }
  const Numbering numbering(model);
  const Scatter scatter(numbering, PETSC_COMM_SELF);
  const double kept = static_cast<double>(numbering.part_bytes() + scatter.bytes()) / n;
  const double physical = sizeof(SpringData) + 2 * sizeof(int);
  EXPECT_LE(of_elements + kept - physical, 200);
  RecordProperty("bytes", static_cast<int>(of_elements + kept - physical));
  std::printf("%.0f bytes an element beyond its data: %.0f the element, %.0f numbering and places\n",
              of_elements + kept - physical, of_elements - physical, kept);
}

TEST(Block, AssemblyAllocatesNothing) {
  const Model model = row_of_masses(100, true, false);
  const Numbering numbering(model);
  Assembler assembler(model, numbering, PETSC_COMM_SELF);
  const Configuration state = shaken(numbering);
  Owned<Vec> r;
  *r.out() = assembler.new_vector();
  assembler.residual(state, r);
  assembler.tangent(state, {1, 20, 400});
  const std::size_t before = allocated;
  assembler.residual(state, r);
  assembler.tangent(state, {1, 20, 400});
  EXPECT_EQ(allocated, before);
}

}  // namespace
}  // namespace engrane::test
