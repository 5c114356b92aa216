// SPDX-License-Identifier: BSD-3-Clause
#include "assembly/fillings.hpp"

#include <cmath>
#include <numeric>

namespace engrane {

Fillings::Fillings(Assembler& assembler) : assembler_(assembler) {
  for (const int p : assembler.own_parts())
    if (const auto* filled = dynamic_cast<const Filled*>(assembler.model().part(p).element.get())) parts_.push_back({p, filled});
}

Fillings::At Fillings::at(const Configuration& c) const {
  At found;
  found.reserve(parts_.size());
  for (const Part& p : parts_) found.push_back(p.filled->filling(assembler_.view(p.part, c)));
  return found;
}

std::vector<double> Fillings::works(const At& from, const At& to, const At& volumes) const {
  std::vector<double> works(parts_.size());
  for (std::size_t i = 0; i < works.size(); ++i)
    works[i] = parts_[i].filled->work_of_filling(from[i].content, to[i].content, volumes[i].volume);
  return works;
}

double Fillings::work(const At& from, const At& to) const {
  At mean = from;
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i].volume = std::sqrt(from[i].volume * to[i].volume);
  const std::vector<double> all = works(from, to, mean);
  return std::accumulate(all.begin(), all.end(), 0.0);
}

double Fillings::work_at_end(const At& from, const At& to) const {
  const std::vector<double> all = works(from, to, to);
  return std::accumulate(all.begin(), all.end(), 0.0);
}

double Fillings::integrand(const At& begin, const At& at) {
  double sum = 0;
  for (std::size_t i = 0; i < at.size(); ++i) sum += (at[i].content - begin[i].content) * at[i].growth;
  return sum;
}

double Fillings::power(const At& at) {
  double sum = 0;
  for (const Filled::Filling& f : at) sum += f.power;
  return sum;
}

}  // namespace engrane
