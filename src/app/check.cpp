// SPDX-License-Identifier: BSD-3-Clause
#include "app/check.hpp"

#include <fmt/format.h>

#include <ostream>

#include "app/summary.hpp"

namespace engrane {

void print_model(const Model& model, std::ostream& out) {
  const Numbering numbering(model);
  if (!model.title.empty()) out << model.title << '\n';
  out << describe_analysis(model) << "\n\n" << listing_built(summarize(model, numbering)) << describe_geometry(model);
  if (!model.commands.checks.empty()) out << fmt::format("\n  {} checks (.CHK) will be made\n", model.commands.checks.size());
}

}  // namespace engrane
