#pragma once
/// Rigid planes that the body may touch (plane.h). The planes are at rest or move along their normals.

#include <algorithm>
#include <optional>

#include "loads/load.h"

namespace pseudorigid::loads {

struct RigidPlanes {
  std::vector<double> normals, points;         ///< normal (any length > 0) and a point of each plane, 3 numbers each
  std::optional<double> stiffness;             ///< stiffness k; empty: `usual_stiffness`
  double damping = 0;                          ///< damping coefficient β
  double friction = 0;                         ///< coefficient of friction f
  std::optional<double> slip_speed{};          ///< slip speed s; empty: `usual_slip_speed`
  std::vector<double> speeds{}, amplitudes{};  ///< speed u and amplitude A of each plane; missing: 0
  double frequency = 0;                        ///< angular frequency Ω of all planes

  /// Default stiffness in internal units. For an elastic body without self-gravity it is 1000 shear moduli per radius.
  static constexpr double usual_stiffness = 1000;
  /// Default slip speed in internal units. For an elastic body without self-gravity it is 0.001 speeds of shear waves.
  static constexpr double usual_slip_speed = 1e-3;

  template <class Self, class Visit>
  static void visit_entries(Self& self, Visit& visit) {
    visit(self.normals, scene::Rows{3, true},
          scene::About{"Loads/Plane normals", "",
                       "Normals of rigid planes that the body may touch, a row each; several planes make a wedge or a "
                       "box. A normal points to the side of the body and has any length."});
    visit(self.points, scene::Rows{3, true},
          scene::About{"Loads/Plane points", "length",
                       "A point of each plane, in the order of the normals. The body begins on the inner side of all "
                       "planes."});
    visit(self.stiffness, scene::AutoOrNumber{scene::positive},
          scene::About{"Loads/Plane stiffness", "pressure/length",
                       "Stiffness k of the contact. A point of the surface that is d behind a plane feels the pressure "
                       "k d along the normal, per undeformed area. The penetration falls as 1/k, and the step falls as "
                       "1/sqrt(k). auto is 1000 density radius/t^2 with the unit of time t of "
                       "the scene. Without self-gravity, this is 1000 shear moduli per radius."});
    visit(self.damping, scene::not_negative,
          scene::About{"Loads/Plane damping", "time/length",
                       "b of a contact that takes energy: the pressure is k d (1 + b d') with the rate d' of the "
                       "penetration (Hunt and Crossley 1975)."});
    visit(
        self.friction, scene::not_negative,
        scene::About{"Loads/Plane friction", "",
                     "Coefficient f of Coulomb's friction. A point of the surface with the tangential velocity v feels "
                     "the traction -f k d v/sqrt(v^2 + s^2), with the pressure k d and the slip speed s."});
    visit(
        self.slip_speed, scene::AutoOrNumber{scene::positive},
        scene::About{"Loads/Plane slip speed", "length/time",
                     "s of the friction. Much faster points slide; much slower points stick, and creep a little. auto "
                     "is 0.001 radius/t with the unit of time t of the scene. Without self-gravity, this is 0.001 "
                     "times the speed of shear waves."});
    visit(self.speeds, scene::Numbers{.may_be_empty = true},
          scene::About{"Loads/Plane speeds", "length/time",
                       "Speed u of each plane along its normal, in the order of the normals. The plane is at z + u t + "
                       "A sin(W t), with its position z at time 0. Empty means 0. The column external subtracts the "
                       "energy that the planes have given, so that the column energy is constant."});
    visit(self.amplitudes, scene::Numbers{.may_be_empty = true},
          scene::About{"Loads/Plane amplitudes", "length",
                       "Amplitude A of the oscillation of each plane along its normal. Empty means 0."});
    visit(self.frequency, scene::Number{},
          scene::About{"Loads/Plane frequency", "1/time", "Angular frequency W of the oscillation of all planes."});
  }

  static constexpr std::string_view no_equilibria = "no body is looked for in equilibrium on a plane";
  static constexpr std::string_view skipped = "contact: Loads/Plane normals is empty; no search for touching points";
  std::string needed(const BodyFacts&) const {
    const Planes planes = forcing().planes;
    return "contact with rigid planes: " + std::to_string(planes.size()) + (planes.rough() ? ", with friction" : "") +
           (planes.moving() ? ", in motion, and the energy that they give" : "");
  }
  /// The search for equilibria does not include bodies at rest on a plane.
  static constexpr bool has_static_equilibria = false;

  /// Returns a Forcing that contains the planes with unit normals. Normals without a point, points without a normal,
  /// and normals of length 0 are omitted here. scene/contact.h rejects such scenes.
  Forcing forcing() const {
    Forcing sum;
    for (std::size_t i = 0; i + 2 < std::min(normals.size(), points.size()); i += 3) {
      const Eigen::Vector3d n(normals[i], normals[i + 1], normals[i + 2]), a(points[i], points[i + 1], points[i + 2]);
      if (const double length = n.stableNorm(); length > 0)
        sum.planes.push_back({.normal = n / length,
                              .position = n.dot(a) / length,
                              .stiffness = stiffness.value_or(usual_stiffness),
                              .damping = damping,
                              .friction = friction,
                              .slip_speed = slip_speed.value_or(usual_slip_speed),
                              .speed = i / 3 < speeds.size() ? speeds[i / 3] : 0,
                              .amplitude = i / 3 < amplitudes.size() ? amplitudes[i / 3] : 0,
                              .frequency = frequency});
    }
    return sum;
  }
  /// Returns the angular frequency of the oscillation, or 0 if no plane oscillates.
  double angular_frequency() const {
    const Planes planes = forcing().planes;
    const bool any = std::any_of(planes.begin(), planes.end(), [](const Plane& plane) { return plane.amplitude != 0; });
    return any ? frequency : 0;
  }

  /// Returns the reason why x_i = 0 is not a plane of symmetry: a clause about the first plane whose mirror image is
  /// not in the list. Empty if the list contains all images.
  std::optional<std::string> breaks_plane(int i) const {
    const Planes planes = forcing().planes;
    for (std::size_t j = 0; j < planes.size(); ++j) {
      Plane image = planes[j];
      image.normal[i] = -image.normal[i];
      if (std::find(planes.begin(), planes.end(), image) == planes.end())
        return "plane " + std::to_string(j + 1) + " of Loads/Plane normals has no mirror image among the planes";
    }
    return std::nullopt;
  }
};

}  // namespace pseudorigid::loads
