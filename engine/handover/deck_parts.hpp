// Lines of decks that LAMMPS and LIGGGHTS have alike.
#pragma once

#include <string>
#include <vector>

#include "engine/handover/carried_scene.hpp"

namespace grainreel {

// Names of files in a hand-over's folder.
inline constexpr const char* data_name = "grains.data";
inline constexpr const char* end_name = "end.restart";
std::string deck_name(PeerEngine engine);     // "in.lammps"
std::string dump_name(PeerEngine engine);     // "lammps.dump"
std::string restart_name(PeerEngine engine);  // "lammps.restart"; a point and the engine's step follow
// "restart 1000 lammps.restart.*": some ten of them.
std::string restart_line(const CarriedScene& carried);

// "processors 1 * *", or none where the engine chooses.
std::string processors_line(const CarriedScene& carried);
// v_t, the drive's variables, and those of turning faces (v_angle0, v_rate0, ...).
std::vector<std::string> variable_lines(const CarriedScene& carried);
// fix gravity, and fix ride in the container's frame.
std::vector<std::string> gravity_lines(const CarriedScene& carried);
// Numbers with all digits, with blanks between.
std::string three(const Vec3& v);

}  // namespace grainreel
