#include "engine/lab/chart/chart.hpp"

#include "engine/lab/chart/accuracy/accuracy.hpp"
#include "engine/lab/chart/accuracy/savings.hpp"
#include "engine/lab/chart/limits/stability.hpp"
#include "engine/lab/chart/validation/validation.hpp"

namespace grainreel {

const std::vector<Chart>& charts() {
    static const std::vector<Chart> all = {
        {"accuracy", "error against cost: restitution, rebound, energy, a small bed", run_accuracy,
         accuracy_drawing},
        {"validation", "published experiments and laws: impacts, packings, silo, cooling gas", run_validation,
         validation_drawing},
        {"stability", "where each method fails, against theory: step, speed, stiffness, drive, round-off",
         run_stability, stability_drawing},
        {"savings", "what leaving friction, walls' motion and the like out of a scene saves", run_savings,
         savings_drawing},
    };
    return all;
}

}  // namespace grainreel
