// Writes the decks (input scripts) of both engines: what they have in common, at which steps they dump, and
// the parts that are different. decks.cpp has what is common; lammps_deck.cpp, liggghts_deck.cpp and
// liggghts_law.cpp have the rest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/handover/carried_scene.hpp"

namespace grainreel {

// Names of files in the folder of a hand-over.
inline constexpr const char* data_name = "grains.data";
inline constexpr const char* end_name = "end.restart";
std::string deck_name(PeerEngine engine);  // "in.lammps"
std::string dump_name(PeerEngine engine);  // "lammps.dump"
// "lammps.restart", to which a point and the engine's step are added.
std::string restart_name(PeerEngine engine);
// When a signal asks LIGGGHTS to end, it writes a restart file: its name is forced_begin, the step and
// forced_end. The file is whole once the output has forced_words.
inline constexpr const char *forced_begin = "restart_forced_liggghts_", *forced_end = ".data";
inline constexpr const char* forced_words = "Forced restart written";
// "restart 1000 lammps.restart.*": about ten restart files, at least 1000 steps apart.
std::string restart_line(const CarriedScene& carried);

// "processors * * 1"; a star where the engine chooses.
std::string processors_line(const CarriedScene& carried);
// Variables: v_t, those of the drive, and those of turning faces (v_angle0, v_rate0, ...). None if nothing is
// driven or turns.
std::vector<std::string> variable_lines(const CarriedScene& carried);
// The command fix gravity and, in the container's frame, fix ride.
std::vector<std::string> gravity_lines(const CarriedScene& carried);
// Three numbers with all their digits and blanks between them.
std::string three(const Vec3& v);

// A series of dumps at from + floor(k every + 1/2), k = 0 ... count. `dump ... N` only knows multiples of N,
// but pictures are at the steps nearest to equally spaced times. So a variable of the deck computes the next
// step, and a few series are enough for thousands of pictures.
struct DumpPace {
    std::int64_t from = 0;
    double every = 1;  // steps, at least 1
    std::int64_t count = 0;
    std::int64_t at(std::int64_t k) const;
    std::int64_t end() const { return at(count); }
    // The step of the first dump after `step`, as the deck's variable computes it.
    std::int64_t next(std::int64_t step) const;
    // The text of that formula for an engine whose steps are ours plus `shift`.
    std::string next_text(std::int64_t shift) const;
};

// Finds a few series that go through all of these rising steps. Each is as long as possible and begins where
// the one before ends. None for less than two steps.
std::vector<DumpPace> dump_paces(const std::vector<std::int64_t>& steps);

// The deck of LAMMPS, for the version of 29 Sep 2021. It reads grains.data and writes lammps.dump and
// end.restart.
std::string lammps_deck(const CarriedScene& carried);

// Number of atom types in the data file of LIGGGHTS: those of grains, and one for each surface.
std::size_t liggghts_types(const CarriedScene& carried);

// The deck of LIGGGHTS, for LIGGGHTS-PUBLIC 3.8.0. It reads grains.data and walls/*.stl. It writes
// liggghts.dump, liggghts.restart.STEP while it runs, end.restart, and outflow.txt where there is an outlet.
std::string liggghts_deck(const CarriedScene& carried);

// The contact laws of a scene as LIGGGHTS wants them: a model, its flags, and matrices by pairs of types.
struct LiggghtsLaw {
    std::string model;                    // "model hooke/stiffness tangential history"
    std::string flags;                    // "absolute_damping off limitForce on tangential_damping off"
    std::vector<std::string> properties;  // a line for each property
};

// All pairs have the same law. Pairs that never touch get numbers of another contact, because the matrices
// must be full.
LiggghtsLaw liggghts_law(const CarriedScene& carried);

// In `luding`, unloading is at most so many times as stiff as loading.
inline constexpr double kLudingRatio = 50;
// The plasticity depth that gives K2 = K1 + S F_max: (r - 1)^2 / (2 r S R_eff), where r is kLudingRatio.
double luding_depth(const CarriedPair& pair);

}  // namespace grainreel
