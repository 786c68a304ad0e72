// The rate at which a vessel runs out, as Beverloo's law expects it, and as it was between two shares of what
// has run out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene.hpp"

namespace grainreel {

// The rate (kg/s) of the law of Beverloo, Leniger and van de Velde (Chem. Eng. Sci. 15, 260, 1961). A round
// hole of diameter D has W = 0.58 rho sqrt(g) (D - 1.4 d)^(5/2); a slot of width B and length L has W = 1.03
// rho sqrt(g) (L - 1.4 d) (B - 1.4 d)^(3/2) (Nedderman, Statics and Kinematics of Granular Materials, 1992,
// ch. 10), with L in place of L - 1.4 d where the slot has no ends (periodic depth). d is the mean diameter,
// and rho is kFlowingFraction of the mean density of the grains. None without an outlet in a container's
// floor, without gravity straight down on it, or where the outlet is narrower than the law can tell.
std::optional<double> beverloo_rate(const Scene& scene);
inline constexpr double kFlowingFraction = 0.6;
// The law in words, with its numbers: "for a slot of 18 mm, W = 1.03 rho ...".
std::string beverloo_words(const Scene& scene);
// Why the law expects no rate; empty where it does.
std::string why_no_beverloo(const Scene& scene);

// The mean rate (kg/s) between the moments at which 10 % and 70 % of all that has run out by the last time
// were out. times (s) rise; gone: kg that are out. None where nothing ran out, or where all did between two
// times.
std::optional<double> mean_outflow_rate(const std::vector<double>& times, const std::vector<double>& gone);
// The index of the first time at which this mass is out.
std::size_t first_with(const std::vector<double>& gone, double mass);

}  // namespace grainreel
