// Energies of the grains (J), and the energy balance of a run. The elastic energy and the balance look at the
// contacts through the step loop.
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
double wall_work(const Grains& grains);  // done by moving walls since the drive started

// A summary of all contacts, from one pass over them.
struct ContactSummary {
    double stored = 0;           // J
    double carrying = 0;         // number of contacts that carry force; a pair counts for both grains
    double largest_overlap = 0;  // as a share of the smaller radius
};
ContactSummary summarise_contacts(const StepLoop& loop, std::int64_t step);

// The total energy (J): kinetic, rotational, gravitational and elastic.
double total_energy(const Surroundings& around, const Grains& grains, const StepLoop& loop,
                    std::int64_t step);

// The energy balance of a run, term by term. The energy that walls give and contacts take is measured at the
// contacts; no term is inferred from the others. The residual is the error of the finite step.
//
// Latching is unloading along a steeper line than loading, as in the law of Walton and Braun. It takes the
// area between the two lines, (K1/2)(1 - e^2) a_max^2, as the largest overlap a_max grows. Friction takes T .
// ds minus the energy that its springs keep. Dashpots take their force times velocity, and walls give their
// force times the wall's velocity. These three are summed by the trapezoidal rule over the steps. With
// velocity Verlet the step itself follows this rule: sum dt F . v is the change of m v^2 / 2 to the last
// digit, except for m (dt a)^2 / 8 at either end (by expanding Swope et al. 1982, J. Chem. Phys. 76, 637).
struct EnergyTerms {
    double kinetic = 0, rotational = 0, gravitational = 0, stored = 0;  // J, at the last step noted

    // J, since the balance began.
    double wall_work = 0;  // done by moving walls on the grains, also through friction
    double latching = 0, friction = 0, damping = 0;
    double came = 0, left = 0;  // energy of grains that came, and of grains that left
    // Energy (J) that friction gave back beyond its spring's T^2 / (2 K0); it is a part of `friction`. A
    // linear spring gives back none. Incremental slip has no state function, so it may give back energy on
    // closed paths of (N, T).
    double given_back = 0;

    double held() const { return kinetic + rotational + gravitational + stored; }
    double lost() const { return latching + friction + damping; }

    // Calls of() once for every number. The order is that of the checkpoint.
    template <class Terms, class Each>
    static void each(Terms& t, const Each& of) {
        of(t.kinetic), of(t.rotational), of(t.gravitational), of(t.stored), of(t.wall_work), of(t.latching);
        of(t.friction), of(t.damping), of(t.came), of(t.left), of(t.given_back);
    }
};

class EnergyBalance {
  public:
    // Begins with the state at `step`. The references must outlive the balance. `step_length` is in s.
    EnergyBalance(const Surroundings& around, const Grains& grains, const StepLoop& loop, std::int64_t step,
                  double step_length);

    // Notes a step. Call it after every step with the step's number.
    void note(std::int64_t step);

    // Saves and loads the whole state, bit by bit, to go on with the same grains and loop. Reading fails for
    // anything that save() cannot have written.
    void save(std::ostream& out) const;
    void load(Bytes& in);

    const EnergyTerms& terms() const { return terms_; }
    // Energy (J) that the grains hold beyond what the balance says.
    double residual() const {
        return terms_.held() + terms_.left - terms_.came - held_at_start_ - terms_.wall_work + terms_.lost();
    }

  private:
    // The data of one contact at the last step at which it touched.
    struct Kept {
        std::int64_t step;
        double latched = 0, sideways = 0;  // J
        double rubbing = 0;                // W
    };
    // A contact that touched at a step. Contacts are kept in the order in which the loop shows them. Few
    // contacts come or go in a step, so most are found right after the contact found before, without a search
    // in a map.
    struct Touching {
        std::uint64_t key;
        Kept kept;
    };

    // Powers (W) at one step.
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
    const double half_step_;                   // s
    std::vector<Touching> contacts_, before_;  // contacts at the last step noted, and at the one before it
    std::vector<char> goes_on_;                // whether each contact of before_ still touches
    std::size_t place_ = 0;  // place in before_ after the last contact that was found in order
    std::unordered_set<std::uint64_t> touching_;  // the keys of contacts_
    std::unordered_map<std::uint64_t, std::size_t>
        places_;  // places in before_, for contacts whose order has changed
    Powers powers_;
    EnergyTerms terms_;
    double held_at_start_ = 0, work_at_start_ = 0;  // J
    Traffic traffic_;                               // the account until the last step noted
    double came_at_start_ = 0, left_at_start_ = 0;  // J
    bool some_left_ = false, opened_ = false;  // whether grains left, or an outlet opened, in the last step
    std::vector<std::int32_t> present_;        // rising ids of the grains that stayed, if some left
    std::vector<std::size_t>
        ended_;  // places in before_ of contacts that ended in the last step, by rising key
    // How often each grain at a mesh has been shown at the present step, by the key of its first contact.
    std::unordered_map<std::uint64_t, std::uint64_t> shown_;
};

}  // namespace grainreel
