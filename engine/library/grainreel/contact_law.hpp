/// @file
/// A contact law of one's own.
#pragma once

#include <span>

#include "grainreel/vector.hpp"

namespace grainreel::v1 {

/// What a law is told of a contact, once a step.
struct Touch {
    double overlap = 0;        ///< m, > 0.
    Vector normal{};           ///< Unit, from the first body to the second; a wall is always the second.
    double closing_speed = 0;  ///< m/s, > 0 while the bodies approach; estimated for the time of the force.
    Vector slip_velocity{};    ///< m/s, of the first surface against the second, across the normal.
    Vector slip{};             ///< m, that the first surface slipped over the second in this step.
    double step = 0;           ///< s, since the last call for this contact.

    double effective_mass = 0;    ///< kg: m1 m2 / (m1 + m2); of a wall the grain's mass.
    double effective_radius = 0;  ///< m: r1 r2 / (r1 + r2); of a wall the grain's radius.
    double stiffness = 0;         ///< N/m, as the scene or its plan has it for this pair (ContactNumbers).
    double restitution = 1;       ///< As the scene has it for this pair.
    double friction = 0;          ///< As the scene has it for this pair.
};

/// What a law answers.
struct ContactForce {
    double normal = 0;    ///< N, pushes the bodies apart; below 0 it pulls them together.
    Vector tangential{};  ///< N, on the second body; the opposite acts on the first. Across the normal.
};

/// What a law keeps of a contact from step to step. All is zero when the contact begins, and forgotten when
/// the overlap ends.
struct ContactMemory {
    std::span<double> numbers;  ///< As many as ContactLaw::numbers() says.
    /// As many as ContactLaw::vectors() says. They turn with the contact, and change sign when the two bodies
    /// change places, so a tangential spring is one of them.
    std::span<Vector> vectors;
};

/// A law between two grains, or a grain and a wall: derive from it, and give it to SimulationOptions::laws.
///
/// The scene's own law still decides the time step: say a stiffness that is like yours (contact.stiffness),
/// and run.step if that is not enough. Calls are slower than the laws of the program, which take several
/// contacts at once: docs/guide/library.md has the figure. Numbers are doubles whatever run.precision says,
/// and a resistance to rolling that the scene has comes on top.
class ContactLaw {
  public:
    virtual ~ContactLaw();

    /// How many numbers it keeps of a contact; at most 16.
    virtual int numbers() const { return 0; }
    /// How many vectors it keeps of a contact; at most 4.
    virtual int vectors() const { return 0; }

    /// The force at the end of a step. It is called from several threads at once, and must depend on nothing
    /// but its arguments if runs are to be alike. To see forces as they stand, without a step, it is called
    /// with slip and step zero and a copy of the memory. What it throws comes out of Simulation::advance(),
    /// some steps later.
    virtual ContactForce force(const Touch& touch, ContactMemory memory) const = 0;

    /// J, that the contact would give back if it were unloaded now. By itself it is NaN, not known: measures
    /// of energy are then NaN too, and nobody watches whether the run gains energy out of nothing.
    virtual double stored_energy(const Touch& touch, ContactMemory memory) const;
};

}  // namespace grainreel::v1
