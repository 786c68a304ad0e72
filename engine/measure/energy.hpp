// Energies of the grains (J), and the energy balance of a run. Both look at the contacts through the step
// loop.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "engine/base/binary.hpp"
#include "engine/state/grains.hpp"
#include "engine/step/step_loop.hpp"

namespace grainreel {

class StepLoop;
struct Surroundings;

struct Kinetic {
    double translation = 0, rotation = 0;
};

Kinetic kinetic_energy(const Grains& grains);
double gravitational_energy(const Grains& grains, const Vec3& gravity);  // zero at the origin
double wall_work(const Grains& grains);  // by moving walls, since the drive started

// What all contacts would give back, and how they stand. One pass over the contacts.
struct ContactSummary {
    double stored = 0;           // J
    double carrying = 0;         // contacts that carry force, a pair counted for both grains
    double largest_overlap = 0;  // over the smaller radius
};
ContactSummary summarise_contacts(const StepLoop& loop, std::int64_t step);

// J: kinetic, rotational, gravitational and elastic together.
double total_energy(const Surroundings& around, const Grains& grains, const StepLoop& loop,
                    std::int64_t step);

// The energy balance of a run, term by term. What walls give and what contacts take is measured at the
// contacts; no term is inferred from the others. The rest is the error of the finite step.
//
// Latching takes what its law says, the area between its slopes: (K1/2)(1 - e^2) a_max^2, as a_max grows.
// Friction takes T . ds less what its springs keep, dashpots their force times velocity, walls give theirs
// times the wall's velocity; all three by the trapezoidal rule over the steps. With velocity Verlet that rule
// is what the step itself does with a force: sum dt F . v is the change of m v^2 / 2 to the last digit, but
// for m (dt a)^2 / 8 at either end (by expanding Swope et al. 1982, J. Chem. Phys. 76, 637).
struct EnergyTerms {
    double kinetic = 0, rotational = 0, gravitational = 0, stored = 0;  // J, now

    // J, since the balance began.
    double wall_work = 0;  // by moving walls on the grains, through friction too
    double latching = 0, friction = 0, damping = 0;
    double came = 0, left = 0;  // with grains that came, and with such as left
    // J, part of the friction: what it gave back beyond its spring's T^2 / (2 K0). A linear spring gives back
    // none. Incremental slip has no state function and may, on closed paths of (N, T).
    double given_back = 0;

    double held() const { return kinetic + rotational + gravitational + stored; }
    double lost() const { return latching + friction + damping; }

    // Names every number once, for saving and loading.
    template <class Terms, class Each>
    static void each(Terms& t, const Each& of) {
        of(t.kinetic), of(t.rotational), of(t.gravitational), of(t.stored), of(t.wall_work), of(t.latching);
        of(t.friction), of(t.damping), of(t.came), of(t.left), of(t.given_back);
    }
};

class EnergyBalance {
  public:
    // Begins with the state at `step`; all must outlive the balance. step_length: s.
    EnergyBalance(const Surroundings& around, const Grains& grains, const StepLoop& loop, std::int64_t step,
                  double step_length);

    // Call after every step, with its number.
    void note(std::int64_t step);

    // All of its state, bit by bit, to go on with the same grains and loop. The reading fails where save()
    // could not have written what is read.
    void save(std::ostream& out) const;
    void load(Bytes& in);

    const EnergyTerms& terms() const { return terms_; }
    // J: what the grains hold more than the balance says.
    double residual() const {
        return terms_.held() + terms_.left - terms_.came - held_at_start_ - terms_.wall_work + terms_.lost();
    }

  private:
    // What is kept of one contact, at the last step it touched.
    struct Kept {
        std::int64_t step;
        double latched = 0, sideways = 0;  // J
        double rubbing = 0;                // W
    };
    // What touched at a step, in the order in which the loop shows it. From one step to the next few contacts
    // come or go, so each is found where the one before it was: no map is searched for it.
    struct Touching {
        std::uint64_t key;
        Kept kept;
    };

    // W, at one step.
    struct Powers {
        double walls = 0, damping = 0;
    };

    template <class Balance, class Each>
    static void transfer(Balance& balance, const Each& each);
    void look(std::int64_t step);
    void add_contact(std::int64_t step, const ContactView& contact);
    const Kept* found(std::uint64_t key);
    void end_contacts();
    void note_traffic();
    bool are_there(std::uint64_t key) const;
    static bool is_at_wall(std::uint64_t key) { return (key >> 31 & 1) != 0; }
    void add_friction(double spent);
    std::uint64_t key(const ContactView& contact);
    std::uint64_t key_at_wall(std::uint64_t first, const ContactView& contact);

    const Surroundings& around_;
    const Grains& grains_;
    const StepLoop& loop_;
    const double half_step_;                      // s
    std::vector<Touching> contacts_, before_;     // at the last step looked at, and at the one before it
    std::vector<char> goes_on_;                   // of before_: whether it touches still
    std::size_t place_ = 0;                       // in before_, behind the last that was found in order
    std::unordered_set<std::uint64_t> touching_;  // the keys of contacts_
    std::unordered_map<std::uint64_t, std::size_t> places_;  // of before_, where the order has changed
    Powers powers_;
    EnergyTerms terms_;
    double held_at_start_ = 0, work_at_start_ = 0;  // J
    Traffic traffic_;                               // until the last step noted
    double came_at_start_ = 0, left_at_start_ = 0;  // J
    bool some_left_ = false, opened_ = false;       // in the last step
    std::vector<std::int32_t> present_;             // ids, rising, when that was so
    std::vector<std::size_t> ended_;                // in the last step: places in before_, by rising key
    // At the step looked at: how often each grain at a mesh has been shown, by the key of its first contact.
    std::unordered_map<std::uint64_t, std::uint64_t> shown_;
};

}  // namespace grainreel
