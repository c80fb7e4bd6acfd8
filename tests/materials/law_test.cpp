/// Every law of the table: the energy is that of its definition in the invariants, to round-off of the strain; P and
/// the tangent are its derivatives by complex step; objectivity and isotropy; stress and moduli at rest.

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <variant>

#include "materials/eigen_tensor.h"
#include "materials/law_checks.h"
#include "materials/law_table.h"
#include "materials/rest_moduli.h"

namespace pseudorigid::materials {
namespace {

using Eigen::Matrix3d;
using Real = Tensor<double>;
__extension__ typedef __float128 Quad;

constexpr double mu = 1.3, lambda = 0.8, b = 0.3, J_m = 20;

/// ln x = 2 artanh((x − 1)/(x + 1)), brought near 1 by factors of two.
Quad log_of(Quad x) {
  if (x > 2) return log_of(x / 2) + log_of(2);
  if (x < 0.5) return log_of(2 * x) - log_of(2);
  const Quad s = (x - 1) / (x + 1);
  Quad sum = 0, power = s;
  for (int n = 1; n < 80; n += 2, power *= s * s) sum += power / n;
  return 2 * sum;
}

/// The stored energy as PHYSICS prints it, in the invariants I = |F|², II = |cof F|², III = (det F)².
Quad definition(std::string_view name, bool incompressible, Quad I, Quad II, Quad III) {
  const Quad bulk = III - 1 - log_of(III), shear = I - 3 - log_of(III), own_bulk = incompressible ? 0 : lambda;
  if (name == "neo-hookean") return mu / 2 * shear + own_bulk / 4 * bulk;
  if (name == "ciarlet-geymonat") return mu / 2 * shear + Quad(lambda) / 4 * bulk;
  if (name == "ciarlet-geymonat (as printed)") return mu / 2 * shear + Quad(lambda) / 2 * bulk;
  if (name == "mooney-rivlin")
    return mu / 2 * ((1 - Quad(b)) * (I - 3) + b * (II - 3)) - mu * (1 + Quad(b)) * log_of(III) / 2 +
           own_bulk / 4 * bulk;
  if (name == "gent") {
    const Quad rest = 1 - (I - 3) / Quad(J_m);
    return -mu / 2 * Quad(J_m) * log_of(rest) - mu * log_of(III) / 2 + own_bulk / 4 * bulk;
  }
  if (name == "saint-venant-kirchhoff")
    return Quad(lambda) / 8 * (I - 3) * (I - 3) + Quad(mu) / 4 * (I * I - 2 * II - 2 * I + 3);
  if (name == "saint-venant-kirchhoff (as printed)") return Quad(lambda) / 2 * (I - 3) * (I - 3) + mu * (I - 3);
  if (name == "none") return 0;
  ADD_FAILURE() << "no definition of " << name;
  return 0;
}
Quad definition(std::string_view name, bool incompressible, const Real& F) {
  Tensor<Quad> quad;
  for (int k = 0; k < 9; ++k) quad(k / 3, k % 3) = F(k / 3, k % 3);
  const Tensor<Quad> cof = cofactor(quad);
  const Quad J = determinant(quad, cof);
  return definition(name, incompressible, dot(quad, quad), dot(cof, cof), J * J);
}

LawParameters parameters() {
  LawParameters p;
  p.shear_modulus = mu;
  p.lame_lambda = lambda;
  p.mooney_fraction = b;
  p.gent_limit = J_m;
  return p;
}

struct Case {
  NamedLaw entry;
  bool incompressible;
  AnyLaw law() const { return entry.make(parameters(), incompressible); }
  friend void PrintTo(const Case& c, std::ostream* out) {
    *out << c.entry.name << (c.incompressible ? ", incompressible" : ", compressible");
  }
};
class EveryLaw : public ::testing::TestWithParam<Case> {
 protected:
  /// Calls use(law) with the law's own type.
  template <class Use>
  void with_law(const Use& use) const {
    std::visit(use, GetParam().law());
  }
  std::string_view name() const { return GetParam().entry.name; }
  bool without_energy() const { return is_fluid(GetParam().law()); }
  bool stressed_at_rest() const { return name() == "saint-venant-kirchhoff (as printed)"; }

  testing::RandomDeformations random_;
};

TEST_P(EveryLaw, EnergyIsThatOfItsDefinition) {
  with_law([&](const auto& law) {
    for (int n = 0; n < 200; ++n) {
      const Real F = to_tensor(random_.deformation());
      const double W = static_cast<double>(definition(name(), GetParam().incompressible, F));
      EXPECT_NEAR(law.energy(F), W, 1e-14 * (1 + std::abs(W)));
    }
  });
}

/// The terms of order 0 and 1 fall out of the definition: it needs 34 digits to be right to 13 at strains of 1e-10.
TEST_P(EveryLaw, EnergyIsAccurateAtSmallStrains) {
  with_law([&](const auto& law) {
    for (const double size : {1e-1, 1e-2, 1e-4, 1e-7, 1e-10})
      for (int n = 0; n < 20; ++n) {
        const Real F = to_tensor(Matrix3d::Identity() + random_.matrix(size));
        const double W = static_cast<double>(definition(name(), GetParam().incompressible, F));
        EXPECT_NEAR(law.energy(F), W, 1e-13 * std::abs(W)) << "size " << size;
      }
  });
}

TEST_P(EveryLaw, StressIsTheDerivativeOfTheEnergy) {
  with_law([](const auto& law) { testing::expect_stress_is_the_derivative_of_the_energy(law); });
}

TEST_P(EveryLaw, TangentIsTheSymmetricDerivativeOfTheStress) {
  with_law([](const auto& law) { testing::expect_tangent_is_the_derivative_of_the_stress(law); });
}

TEST_P(EveryLaw, IsObjectiveAndIsotropic) {
  with_law([](const auto& law) { testing::expect_objective_and_isotropic(law); });
}

/// Exactly zero: round-off of a stress-free body is no motion. The law printed in 5.7.9(3) has the stress 2μ Id.
TEST_P(EveryLaw, LanesAreNumbers) {
  with_law([](const auto& law) { testing::expect_lanes_are_numbers(law); });
}

TEST_P(EveryLaw, IdentityIsFreeOfEnergyAndOfStressButForTheOneAsPrinted) {
  with_law([&](const auto& law) {
    const Real Id = to_tensor(Matrix3d::Identity());
    EXPECT_EQ(law.energy(Id), 0);
    const Matrix3d expected = (stressed_at_rest() ? 2 * mu : 0) * Matrix3d::Identity();
    EXPECT_EQ(to_matrix(law.stress(Id)), expected);
  });
}

/// On GL⁺(3); the law printed in 5.7.9(3) has its least energy at rest on SL(3) only.
TEST_P(EveryLaw, EnergyIsPositiveAwayFromRest) {
  with_law([&](const auto& law) {
    for (int n = 0; n < 200; ++n) {
      Matrix3d F = random_.deformation();
      if (stressed_at_rest()) F /= std::cbrt(F.determinant());
      if (without_energy())
        EXPECT_EQ(law.energy(to_tensor(F)), 0);
      else
        EXPECT_GT(law.energy(to_tensor(F)), 0);
    }
  });
}

/// DP(Id)[H] = 2μ sym H + λ tr H Id, which gives Lamé's moduli at rest.
TEST_P(EveryLaw, TangentAtRestHasTheModuliOfTheLaw) {
  struct {
    double mu, lambda;
  } at_rest{mu, lambda};
  if (name() == "neo-hookean") at_rest = {mu, GetParam().incompressible ? 0 : lambda};
  // The term in II resists changes of volume as well as of shape.
  if (name() == "mooney-rivlin") at_rest = {mu, (GetParam().incompressible ? 0 : lambda) + 2 * b * mu};
  // So does the stiffening, of second order in I − 3.
  if (name() == "gent") at_rest = {mu, (GetParam().incompressible ? 0 : lambda) + 2 * mu / J_m};
  // Correction 9: the printed λ/2 doubles λ.
  if (name() == "ciarlet-geymonat (as printed)") at_rest = {mu, 2 * lambda};
  if (without_energy()) at_rest = {0, 0};
  // Correction 10: with the stress 2μ Id at rest the tangent is not of Hooke's form; 2μH + 4λ tr H Id.
  const double stress_at_rest = stressed_at_rest() ? 2 * mu : 0;
  if (stressed_at_rest()) at_rest = {0, 4 * lambda};
  with_law([&](const auto& law) {
    for (int n = 0; n < 20; ++n) {
      const Matrix3d H = random_.matrix(1), hooke = at_rest.mu * (H + H.transpose()) +
                                                    at_rest.lambda * H.trace() * Matrix3d::Identity() +
                                                    stress_at_rest * H;
      const Matrix3d tangent = to_matrix(law.tangent(to_tensor(Matrix3d::Identity()), to_tensor(H)));
      EXPECT_LE((tangent - hooke).norm(), 1e-14 * hooke.norm());
    }
  });
}

std::string identifier(const ::testing::TestParamInfo<Case>& info) {
  std::string result;
  for (const char c : info.param.entry.name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      result += c;
    else if (c == '-' || c == ' ')
      result += '_';
  return result + (info.param.incompressible ? "_on_Sl3" : "_on_Gl3");
}
std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const NamedLaw& entry : law_table)
    for (const bool incompressible : {false, true}) cases.push_back({entry, incompressible});
  return cases;
}
INSTANTIATE_TEST_SUITE_P(Table, EveryLaw, ::testing::ValuesIn(all_cases()), identifier);

/// On SL(3), where tr H = O(|H|²), the law printed in 5.7.9(3) is neo-Hookean with twice the shear modulus at small
/// strains: the stress at rest is a pressure there. On GL⁺(3) the energy falls when the body shrinks.
TEST(AsPrinted, SaintVenantKirchhoffContractsOrHasTwiceTheShearModulus) {
  const SaintVenantKirchhoffAsPrinted printed{mu, lambda};
  const SaintVenantKirchhoff standard{mu, lambda};
  const double a = 1e-4;
  const Real shear = to_tensor(Eigen::Vector3d(std::exp(a), std::exp(-a), 1).asDiagonal().toDenseMatrix());
  EXPECT_NEAR(printed.energy(shear) / standard.energy(shear), 2, 1e-7);  // the difference is of order a²
  const Real smaller = to_tensor(0.99 * Matrix3d::Identity());
  EXPECT_LT(printed.energy(smaller), 0);
  EXPECT_GT(standard.energy(smaller), 0);
}

/// Runs of a sweep move together if their laws are equal: a number that makes another law must make it unequal.
TEST(LawTable, EveryNumberMakesSomeLawAnotherOne) {
  for (const LawEntry& entry : law_entries) {
    LawParameters other;
    other.*entry.member = other.*entry.member == 0 ? 0.1 : 0.8 * other.*entry.member;
    int n_changed = 0;
    for (const NamedLaw& law : law_table) {
      const AnyLaw a = law.make({}, false), b = law.make(other, false);
      const Real F = to_tensor(Eigen::Vector3d(1.2, 1.1, 0.9).asDiagonal().toDenseMatrix());
      const auto stress = [&](const AnyLaw& l) {
        return to_matrix(std::visit([&](const auto& of) { return of.stress(F); }, l));
      };
      EXPECT_EQ(a == b, stress(a) == stress(b)) << law.name << ", " << entry.path;
      n_changed += a == b ? 0 : 1;
    }
    EXPECT_GE(n_changed, 1) << entry.path;
  }
}

TEST(LawTable, HasEveryNameAndEveryEntryOnce) {
  std::set<std::string_view> names, paths;
  for (const NamedLaw& law : law_table) {
    EXPECT_TRUE(names.insert(law.name).second) << law.name;
    EXPECT_TRUE(law.energy.ends_with(".")) << law.name;
  }
  for (const LawEntry& entry : law_entries) {
    EXPECT_TRUE(paths.insert(entry.path).second) << entry.path;
    EXPECT_TRUE(entry.path.starts_with("Material/")) << entry.path;
    for (const LawEntry& other : law_entries) EXPECT_EQ(entry.member == other.member, &entry == &other) << entry.path;
  }
}

/// A law that is wrong in its own number can be right at the default of this number.
TEST(LawTable, TheseTestsUseNumbersThatAreNotTheDefaults) {
  for (const LawEntry& entry : law_entries)
    EXPECT_NE(parameters().*entry.member, LawParameters{}.*entry.member) << entry.path << " is missing in parameters()";
}

TEST(LawTable, NamesWhatItDoesNotKnow) {
  try {
    (void)make_law("rubber", {});
    FAIL() << "a law called rubber";
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("rubber"), std::string::npos);
  }
}

/// λ of waves: what the law is given, and what its other terms have beside a function of J, 2bμ of Mooney–Rivlin's and
/// 2μ/J_m of Gent's. Saint Venant–Kirchhoff's as printed is under the pressure 2μ at rest, with 2μ and 4λ in their
/// place; where no constraint carries the pressure, waves of pressure feel it. Nothing of a law that is not named here.
std::optional<double> lame_of_waves(std::string_view name, bool incompressible) {
  const double given = incompressible ? 0 : lambda;
  if (name == "neo-hookean") return given;
  if (name == "mooney-rivlin") return given + 2 * b * mu;
  if (name == "gent") return given + 2 * mu / J_m;
  if (name == "ciarlet-geymonat (as printed)") return 2 * lambda;
  if (name == "saint-venant-kirchhoff (as printed)") return 4 * lambda - (incompressible ? 0 : 2 * mu);
  if (name == "ciarlet-geymonat" || name == "saint-venant-kirchhoff") return lambda;
  return {};
}

TEST(RestModuli, AreThoseOfWaves) {
  for (const NamedLaw& law : law_table) {
    if (law.name == "none") continue;
    for (const bool incompressible : {true, false}) {
      SCOPED_TRACE(std::string(law.name) + (incompressible ? ", incompressible" : ""));
      const AnyLaw made = Case{law, incompressible}.law();
      const bool is_stressed = law.name == "saint-venant-kirchhoff (as printed)";
      const RestModuli moduli = moduli_at_rest(made, incompressible);
      EXPECT_NEAR(moduli.shear, is_stressed ? 2 * mu : mu, 1e-14);
      if (const auto lame = lame_of_waves(law.name, incompressible)) {
        EXPECT_NEAR(moduli.lame, *lame, 1e-13);
      }
      EXPECT_NEAR(pressure_at_rest(made), is_stressed ? 2 * mu : 0, 1e-14);
    }
  }
}

}  // namespace
}  // namespace pseudorigid::materials
