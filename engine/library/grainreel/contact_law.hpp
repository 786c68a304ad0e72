/// @file
/// A contact law of one's own.
#pragma once

#include <span>

#include "grainreel/vector.hpp"

namespace grainreel::v1 {

/// What a law is told about a contact, once a step.
struct Touch {
    double overlap = 0;        ///< m, > 0.
    Vector normal{};           ///< Unit, from the first body to the second; a wall is always the second.
    double closing_speed = 0;  ///< m/s, > 0 while the bodies approach; extrapolated to the time of the force.
    Vector slip_velocity{};    ///< m/s, of the first surface relative to the second, without its normal part.
    Vector slip{};             ///< m, by which the first surface slipped over the second in this step.
    double step = 0;           ///< s, one time step; 0 if only the present force is asked for.

    double effective_mass = 0;    ///< kg: m1 m2 / (m1 + m2); at a wall the grain's mass.
    double effective_radius = 0;  ///< m: r1 r2 / (r1 + r2); at a wall the grain's radius.
    double stiffness = 0;         ///< N/m, of this pair, from the scene or its plan (ContactNumbers).
    double restitution = 1;       ///< As the scene has it for this pair.
    double friction = 0;          ///< As the scene has it for this pair.
};

/// What a law answers.
struct ContactForce {
    double normal = 0;    ///< N, pushes the bodies apart; below 0 it pulls them together.
    Vector tangential{};  ///< N, on the second body; the opposite acts on the first. It is perpendicular to
                          ///< the normal.
};

/// What a law keeps about a contact from step to step. All numbers are zero when the contact begins, and they
/// are lost when the overlap ends.
struct ContactMemory {
    std::span<double> numbers;  ///< As many as ContactLaw::numbers() says.
    /// As many as ContactLaw::vectors() says. In each step the program first turns them with the contact and
    /// removes their part along the normal. They change sign when the two bodies change places. So a
    /// tangential spring can be kept as one of them.
    std::span<Vector> vectors;
};

/// A law between two grains, or a grain and a wall. Derive your law from this class, and give it to
/// SimulationOptions::laws.
///
/// The scene's own law still decides the time step. So give the scene a stiffness that is like yours
/// (contact.stiffness), and run.step if that is not enough. Your law is slower than the laws of the program,
/// which compute several contacts at once: docs/guide/library.md has the figure. Numbers are doubles whatever
/// run.precision says. If the scene has a resistance to rolling, it is added.
class ContactLaw {
  public:
    virtual ~ContactLaw();

    /// How many numbers the law keeps about a contact; at most 16.
    virtual int numbers() const { return 0; }
    /// How many vectors the law keeps about a contact; at most 4.
    virtual int vectors() const { return 0; }

    /// The force at the end of a step. The function is called from several threads at once. If runs are to be
    /// alike, its result must depend on nothing but its arguments. To read the present forces without a step,
    /// the program calls it with slip and step zero and a copy of the memory. An exception that it throws
    /// comes out of the function of Simulation that was called (pack(), advance(), contacts(), measures() and
    /// the like), perhaps only after further steps. The same happens if a number of the force is NaN or
    /// infinite: an Error (failure) then names the law by its place in SimulationOptions::laws.
    virtual ContactForce force(const Touch& touch, ContactMemory memory) const = 0;

    /// J, the energy that the contact would give back if it were unloaded now. Without an override it is NaN,
    /// which means unknown: measures of energy are then NaN too, and the program cannot check whether the run
    /// gains energy out of nothing.
    virtual double stored_energy(const Touch& touch, ContactMemory memory) const;
};

}  // namespace grainreel::v1
