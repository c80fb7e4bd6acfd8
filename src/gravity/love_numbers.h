#pragma once
/// Love numbers of a homogeneous incompressible elastic ball under its own gravity. The ball has the radius r, the
/// density ρ and the shear modulus μ. The gravity at its surface is g = (4/3)πGρr. A tidal potential V = V_n (|x|/r)^n
/// Y_n with a spherical harmonic Y_n of degree n causes, at the surface,
///
///   u_r = h_n V/g,    u_t = l_n r∇V/g,    k_n V.
///
/// The three terms are the radial displacement, the tangential displacement, and the additional potential of the
/// displaced mass. The force of the tide per volume is ρ∇V. Only the tangential part of ∇V counts in u_t. In the
/// interior, a pressure balances the force ρ∇V. The tide therefore acts at the surface alone, and its work on a
/// displacement is ρ∮V u_r dS. The displaced mass is a surface layer of the density ρu_r per area, with the potential
/// 3/(2n + 1) g u_r. Therefore
///
///   k_n = 3/(2n + 1) h_n.
///
/// If a mass that lies on the surface has the potential V, its weight is the pressure (2n + 1)/3 ρV on the surface. The
/// work of its attraction and of its weight is −(2/3)(n − 1) times the work of a tide with the potential V. The load
/// Love numbers h'_n, l'_n, k'_n describe the response to such a mass (Farrell, Rev. Geophys. 10, 1972). They are
///
///   h'_n = −(2/3)(n − 1) h_n,    the same factor for l'_n and k'_n.
///
/// The exact numbers are, with γ = ρgr/μ (Thomson 1863; Munk and MacDonald, The Rotation of the Earth, 5.6),
///
///   h_n = (2n + 1)/(2(n − 1)) / (1 + m_n/γ),    l_n = 3/(n(2n + 1)) h_n,    m_n = (2n² + 4n + 3)/n.
///
/// The exact displacement is a polynomial of degree n + 1 in X. The pseudo-rigid ball, x = QX, has a response only for
/// n = 2:
///
///   h₂ = (5/2)/(1 + 25/(2γ)),    l₂ = h₂/2.
///
/// A tide of degree 1 moves the ball as a whole. The Love numbers of degree 1 therefore depend on the frame and are not
/// defined here.

namespace pseudorigid::gravity {

/// Dimensionless Love numbers h = h_n, l = l_n and k = k_n of one degree n ≥ 2.
struct LoveNumbers {
  int degree;
  double h, l;

  double k() const { return 3 / (2.0 * degree + 1) * h; }
  /// Returns the factor −(2/3)(n − 1). The load Love numbers h', l', k' are h, l, k times this factor.
  double load_factor() const { return -2 * (degree - 1) / 3.0; }
};

/// Returns the exact numbers for n ≥ 2 and γ = `gamma` > 0, with γ = ρgr/μ.
inline LoveNumbers exact_love_numbers(int n, double gamma) {
  const double m = (2.0 * n * n + 4 * n + 3) / n;
  const double h = (2.0 * n + 1) / (2 * (n - 1)) / (1 + m / gamma);
  return {n, h, 3 / (n * (2.0 * n + 1)) * h};
}

/// Returns the numbers of the pseudo-rigid ball for n ≥ 2 and γ = `gamma` > 0. They are 0 for n > 2.
inline LoveNumbers pseudo_rigid_love_numbers(int n, double gamma) {
  const double h = n == 2 ? 2.5 / (1 + 12.5 / gamma) : 0.0;
  return {n, h, h / 2};
}

}  // namespace pseudorigid::gravity
