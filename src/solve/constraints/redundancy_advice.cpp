// SPDX-License-Identifier: BSD-3-Clause
#include "solve/constraints/redundancy_advice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "solve/constraints/constraint_factors.hpp"

namespace engrane::solve {

namespace {

/// What a kind of joint holds, by the names of its multipliers; 1 is its axis.
struct Kind {
  const char* name;
  std::set<std::string> holds;
};

/// Usual joints of machines first.
const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {"SPHERICAL", {"FORCE_1", "FORCE_2", "FORCE_3"}},
      {"CYLINDRICAL", {"FORCE_2", "FORCE_3", "MOMENT_2", "MOMENT_3"}},
      {"POINT_LINE", {"FORCE_2", "FORCE_3"}},
      {"HINGE", {"FORCE_1", "FORCE_2", "FORCE_3", "MOMENT_2", "MOMENT_3"}},
      {"PRISMATIC", {"FORCE_2", "FORCE_3", "MOMENT_1", "MOMENT_2", "MOMENT_3"}},
      {"PLANAR", {"FORCE_1", "MOMENT_2", "MOMENT_3"}},
      {"POINT_PLANE", {"FORCE_1"}},
  };
  return all;
}

const std::set<std::string>* joint_holds(const std::string& type) {
  static const std::set<std::string> weld{"FORCE_1", "FORCE_2", "FORCE_3", "MOMENT_1", "MOMENT_2", "MOMENT_3"};
  if (type == "WELD") return &weld;
  for (const Kind& kind : kinds())
    if (type == kind.name) return &kind.holds;
  return nullptr;
}

std::string in_words(const std::string& multiplier) {
  static const char* const axes[] = {"the axis", "the second axis", "the third axis"};
  const char digit = multiplier.back();
  return fmt::format("{} {}", multiplier.starts_with("FORCE") ? "force along" : "moment about",
                     digit >= '1' && digit <= '3' ? axes[digit - '1'] : "it");
}

/// One way of changing an element, and the multipliers that this gives up.
struct Release {
  std::string becomes;
  std::vector<Eigen::Index> rows;
  std::string released;
};

std::vector<Release> releases_of(const Assembler& assembler, int part) {
  const Model::Part& p = assembler.model().parts[static_cast<std::size_t>(part)];
  const auto& multipliers = p.element->layout().multipliers;
  const Eigen::Index begin = assembler.numbering().multiplier_begin(part);
  std::vector<Release> cures;
  if (const auto* held = joint_holds(p.type))
    for (const Kind& kind : kinds()) {
      if (kind.name == p.type || !std::includes(held->begin(), held->end(), kind.holds.begin(), kind.holds.end())) continue;
      Release cure{fmt::format("make {} {} a {}", p.type, p.element->id(), kind.name), {}, ""};
      bool driven = false;
      for (std::size_t i = 0; i < multipliers.size(); ++i) {
        const std::string& name = multipliers[i].name;
        const bool drive = is_drive(multipliers[i]);
        driven = driven || drive;
        if (drive || kind.holds.contains(name)) continue;
        cure.rows.push_back(begin + static_cast<Eigen::Index>(i));
        cure.released += (cure.released.empty() ? "" : ", ") + in_words(name);
      }
      // a joint of another kind may have no such drive
      if (!driven && !cure.rows.empty()) cures.push_back(std::move(cure));
    }
  for (std::size_t i = 0; i < multipliers.size(); ++i) {
    const std::vector<Eigen::Index> row{begin + static_cast<Eigen::Index>(i)};
    const std::string element = fmt::format("{} {}", p.type, p.element->id());
    if (is_drive(multipliers[i])) cures.push_back({"leave out the drive of " + element, row, ""});
    if (multipliers[i].name == "TOOTH") cures.push_back({"give " + element + " a tooth stiffness (KM)", row, ""});
  }
  return cures;
}

}  // namespace

std::string suggest_releases(const Assembler& assembler, const Eigen::MatrixXd& null) {
  const Eigen::Index needed = null.cols();
  const auto parts = static_cast<int>(assembler.model().parts.size());
  std::vector<Release> chosen(static_cast<std::size_t>(parts));
  Eigen::Index given_up = 0;
  // sizes of the rows say nothing: units and lengths are in them
  Eigen::MatrixXd scaled = null;
  for (Eigen::Index j = 0; j < needed; ++j) scaled.col(j) /= std::max(scaled.col(j).lpNorm<Eigen::Infinity>(), 1e-300);
  const auto independent = [&](const std::vector<Eigen::Index>& rows) {
    Eigen::MatrixXd picked(static_cast<Eigen::Index>(rows.size()), needed);
    for (std::size_t i = 0; i < rows.size(); ++i) picked.row(static_cast<Eigen::Index>(i)) = scaled.row(rows[i]);
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(picked.transpose());
    qr.setThreshold(1e-7);
    return qr.rank() == picked.rows();
  };
  // a second pass changes more of a joint that the first has changed already
  for (int pass = 0; pass < 2; ++pass)
    for (int p = parts; p-- > 0 && given_up < needed;) {
      Release& mine = chosen[static_cast<std::size_t>(p)];
      for (const Release& cure : releases_of(assembler, p)) {
        const auto more = static_cast<Eigen::Index>(cure.rows.size() - mine.rows.size());
        if (more <= 0 || given_up + more > needed) continue;
        if (!std::includes(cure.rows.begin(), cure.rows.end(), mine.rows.begin(), mine.rows.end())) continue;
        std::vector<Eigen::Index> rows = cure.rows;
        for (int q = 0; q < parts; ++q)
          if (q != p)
            rows.insert(rows.end(), chosen[static_cast<std::size_t>(q)].rows.begin(),
                        chosen[static_cast<std::size_t>(q)].rows.end());
        if (!independent(rows)) continue;
        given_up += more;
        mine = cure;
        break;
      }
    }
  std::string text;
  constexpr int most = 6;
  int listed = 0;
  for (const Release& cure : chosen) {
    if (cure.rows.empty()) continue;
    if (listed++ >= most) continue;
    text += fmt::format("{}{}{}", text.empty() ? "" : "; ", cure.becomes,
                        cure.released.empty() ? "" : fmt::format(" (releases {})", cure.released));
  }
  if (listed > most) text += fmt::format("; and {} more such changes", listed - most);
  if (!text.empty() && given_up < needed) text += fmt::format("; {} redundant remain, without a simple cure", needed - given_up);
  return text;
}

}  // namespace engrane::solve
