// Lines of decks that LAMMPS and LIGGGHTS have alike.
#pragma once

#include <cstddef>
#include <cstdint>
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

// At which steps an engine dumps. `dump ... N` knows multiples of N alone, and pictures lie at the steps
// nearest to even times; so a variable says the next step, and few runs serve thousands of pictures.

// Dumps at from + floor(k every + 1/2), k = 0 ... count.
struct DumpPace {
    std::int64_t from = 0;
    double every = 1;  // steps, at least 1
    std::int64_t count = 0;
    std::int64_t at(std::int64_t k) const;
    std::int64_t end() const { return at(count); }
    // The step of the first dump behind `step`, as the deck's variable computes it.
    std::int64_t next(std::int64_t step) const;
    // That formula, for engines that count `shift` more steps.
    std::string next_text(std::int64_t shift) const;
};

// As few as go through rising steps, each beginning where the one before ends; none for less than two steps.
std::vector<DumpPace> dump_paces(const std::vector<std::int64_t>& steps);

// The input script of LAMMPS for a scene. Written for the version of 29 Sep 2021.

// Reads grains.data; writes lammps.dump, end.restart.
std::string lammps_deck(const CarriedScene& carried);

// The input script of LIGGGHTS for a scene. Written for LIGGGHTS-PUBLIC 3.8.0.

// Atom types of its data file: those of grains, and one for each surface that they touch.
std::size_t liggghts_types(const CarriedScene& carried);

// Reads grains.data and walls/*.stl; writes liggghts.dump, outflow.txt where there is an outlet,
// liggghts.restart.STEP on its way, end.restart.
std::string liggghts_deck(const CarriedScene& carried);

// One kind of contact in the words of LAMMPS' pair_style granular and its walls.

// "hooke 9600 2647 tangential linear_history 2742 0 0.5 damping mass_velocity limit_damping"
std::string lammps_law(const CarriedPair& pair);

// Faces of a scene as regions of LAMMPS. Internal to its deck.

struct LammpsRegion {
    std::string name;                    // "floor", "left_slant"; a floor with a slot is two: "floor_0"
    std::string text;                    // the whole command
    std::vector<std::string> variables;  // commands before it
};

// The regions of the faces as the run begins, or after the outlet has opened. Names of faces that the outlet
// has changed end in "_open".
std::vector<LammpsRegion> lammps_regions(const CarriedScene& carried, bool opened);

// Where grains leave the run: those of the scene's exits and below its outlet.
std::vector<LammpsRegion> lammps_exits(const CarriedScene& carried);

// The contact laws of a scene as LIGGGHTS wants them: a model, its flags, and matrices by pairs of types.

struct LiggghtsLaw {
    std::string model;                    // "model hooke/stiffness tangential history"
    std::string flags;                    // "absolute_damping off limitForce on tangential_damping off"
    std::vector<std::string> properties;  // lines
};

// All pairs have one law. With the softest number that makes sense where a pair never touches.
LiggghtsLaw liggghts_law(const CarriedScene& carried);

// How many times stiffer than loading the unloading of `luding` can become.
inline constexpr double kLudingRatio = 50;
// The plasticity depth that gives K2 = K1 + S F_max: (r - 1)^2 / (2 r S R_eff).
double luding_depth(const CarriedPair& pair);

}  // namespace grainreel
