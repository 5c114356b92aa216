// SPDX-License-Identifier: BSD-3-Clause
// Laws of springs and dampers, in terms of an elongation or an angle.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "elements/common/building.hpp"
#include "elements/common/law_corners.hpp"
#include "math/taylor.hpp"
#include "model/function.hpp"
#include "model/function_integral.hpp"
#include "user/routine.hpp"

namespace engrane::elements {

/// Keywords shared by SPRING and TSPRING. Without `LAW` the spring is linear with K, without `CLAW` the damper is linear with
/// C.
struct SpringLawData {
  deck::Tagged law;     ///< TABLE f, POLY k1 [k2 [k3]], EXPR f or USER f
  int damping_law = 0;  ///< function of the rate
};

/// Tension of a spring and damper: f(e) + g(ė), with e measured from the unstressed state and the stored energy ∫f from 0 to e.
/// Alternatively a user routine or a formula f(e, ė, t), plus g(ė). A routine may return its energy; that of a formula is ∫f(e,
/// 0) if it does not depend on time. Without an energy all the work counts as dissipated.
struct SpringLaw {
  double k1 = 0, k2 = 0, k3 = 0;              ///< f = k1 e + k2 e² + k3 e³, unless `of_stretch` is given
  const Function* of_stretch = nullptr;       ///< f
  const Expression* formula = nullptr;        ///< f of the elongation, its rate and time
  std::shared_ptr<const user::Routine> user;  ///< likewise
  double damping = 0;                         ///< g = damping ė, unless `of_rate` is given
  const Function* of_rate = nullptr;          ///< g
  LawCorners corners, corners_of_rate;        ///< corners of f and of g
  /// Linear spring that bridges the play of a table, or its slack side: as stiff as f where the play ends, and relaxed in the
  /// middle of it. Its stiffness is 0 if there is no play.
  struct Bridge {
    double stiffness = 0, relaxed = 0;
  } bridge;

  /// Force of spring and damper together. `contact_homotopy` is the fraction of f that the bridge replaces while statics searches
  /// for the end of the play that the load comes to (State::contact_homotopy).
  template <class T>
  T force(const T& stretch, const T& rate, double time, double contact_homotopy) const {
    if (contact_homotopy > 0 && bridge.stiffness > 0)
      return (1 - contact_homotopy) * elastic(stretch) + contact_homotopy * bridge.stiffness * (stretch - bridge.relaxed) +
             viscous(rate);
    if (!formula && !user) return elastic(stretch) + viscous(rate);
    const Expression::Law y = of_both(value_of(stretch), value_of(rate), time);
    return compose(stretch, y.value, y.by_elongation, 0) + compose(rate, 0, y.by_rate, 0) + viscous(rate);
  }
  bool has_corners() const { return corners.count() + corners_of_rate.count() > 0; }
  /// Appends the switch names, one per corner, each prefixed by `before`.
  void name_switches(std::vector<SwitchNames>& names, const std::string& before) const;
  /// Writes the switch values at an elongation with two time derivatives. `size` is the magnitude of the terms whose difference
  /// is `stretch`. Returns the number of switches.
  std::size_t switches(const Taylor& stretch, double time, double size, std::span<Switch> values) const;
  /// Stored energy and dissipated power.
  Energies energies(double stretch, double rate, double time) const;

  bool acts() const { return user || formula || of_stretch || of_rate || k1 != 0 || k2 != 0 || k3 != 0 || damping != 0; }

  /// Builds the law from a card with one stiffness and one damping. Returns nothing, with an error, if both K and LAW or both C
  /// and CLAW are given. For a USER law `first` is the initial elongation and `scale` the elongation over which the law may
  /// change noticeably. `suffix` is appended to the keywords.
  static std::optional<SpringLaw> of(const BuildContext& context, const SpringLawData& data, double stiffness, double damping,
                                     double first, double scale, const std::string& suffix = {});

 private:
  /// f of a formula or a user routine, with its derivatives.
  Expression::Law of_both(double stretch, double rate, double time) const;
  template <class T>
  T elastic(const T& stretch) const {
    if (of_stretch) return evaluate(*of_stretch, stretch);
    if (k2 == 0 && k3 == 0) return k1 * stretch;
    return stretch * (k1 + stretch * (k2 + stretch * k3));
  }
  template <class T>
  T viscous(const T& rate) const {
    return of_rate ? evaluate(*of_rate, rate) : damping * rate;
  }
  double stored(double stretch) const {
    if (of_stretch) return of_stretch->integral(stretch);
    return stretch * stretch * (k1 / 2 + stretch * (k2 / 3 + stretch * (k3 / 4)));
  }

  int formula_id_ = 0;                               ///< id of the function that holds `formula`
  bool user_stores_ = false;                         ///< whether the routine returns the energy
  std::shared_ptr<const PanelIntegral> of_formula_;  ///< ∫f(e, 0) of a formula that does not depend on time
};

/// Adds LAW and CLAW, with `suffix` appended, to a card. In the help `stretch` is the word for e and `force` the word for the
/// result. `Data` is the card's struct or one of its bases.
template <class Data, class Whole>
void add_spring_law(deck::Card<Whole>& card, const std::string& stretch, const std::string& force, const std::string& suffix) {
  deck::Tagged Data::*law = &SpringLawData::law;
  int Data::*damping_law = &SpringLawData::damping_law;
  card.add("LAW" + suffix, law, "instead of K" + suffix + ": " + force + " as a function of the " + stretch)
      .synonyms({"LOI" + suffix})
      .option({"TABLE", {"FONCTION", "FUNCTION"}, "function f of the " + stretch, 1, 1})
      .option({"POLY", {"POLYNOME"}, "k1 e + k2 e2 + k3 e3 of the " + stretch + " e", 1, 3})
      .option({"EXPR", {"FORMULE"}, "f: formula f of .FCT, of the " + stretch + " D, its rate V and the time T", 1, 1})
      .option({"USER", {"UTILISATEUR"}, "f: routine f of .FCT, of the " + stretch + ", its rate and the time", 1, 1});
  card.add("CLAW" + suffix, damping_law, "instead of C" + suffix + ": function of the rate of the " + stretch)
      .synonyms({"LOI_C" + suffix})
      .refers(deck::Reference::function)
      .at_least(0);
}
template <class Data>
void add_spring_law(deck::Card<Data>& card, const std::string& stretch, const std::string& force) {
  add_spring_law<Data, Data>(card, stretch, force, "");
}

}  // namespace engrane::elements
