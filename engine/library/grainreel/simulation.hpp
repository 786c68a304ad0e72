/// @file
/// A scene in motion, step by step.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "grainreel/contact.hpp"
#include "grainreel/contact_law.hpp"
#include "grainreel/frame.hpp"
#include "grainreel/scene.hpp"

namespace grainreel::v1 {

/// Which contacts have a law of your own.
struct LawChoice {
    std::shared_ptr<const ContactLaw> law;  ///< Not null.
    std::string first{};                    ///< Name of a species; empty: any.
    std::string second{};                   ///< Name of a species, or "walls" (or "wall"); empty: anything.
};

/// How a simulation is set up.
struct SimulationOptions {
    int threads = 0;  ///< Up to 1024; 0: as the scene says, or as many as are useful. Results do not change.
    std::vector<LawChoice> laws{};  ///< If two are for one pair, the later one counts.
};

/// A grain that is added while the run goes on.
struct NewGrain {
    std::int32_t species = 0;  ///< Place in Scene::species().
    double radius = 0;         ///< m, in the range of its species.
    double density = 0;        ///< kg/m3, from 1e-6 to 1e9; 0: that of its species.
    Vector position{};         ///< m.
    Vector velocity{};         ///< m/s.
    Vector spin{};             ///< rad/s.
};

/// One number of measures.csv.
struct Measure {
    std::string column{};  ///< The name of its column, from the list in docs/reference/measures.md.
    double value = 0;      ///< In the unit of that list; NaN where there is no value.
};

/// A direction of a field's grid.
struct FieldAxis {
    std::string name{};        ///< "z".
    std::string unit{};        ///< "m".
    std::vector<double> at{};  ///< The middles of the cells, rising.
};

/// Means on a grid, for scenes with output.fields.
struct Field {
    std::string name{};             ///< "solid_fraction".
    std::string unit{};             ///< "1".
    std::vector<FieldAxis> axes{};  ///< The place along the last axis changes fastest in `values`.
    std::vector<double> values{};   ///< One for each cell; NaN where there is no value.
};

/// A scene that is run: the grains are packed and settle, then the drive begins at time 0. It can be moved
/// but not copied; after that, the object that was moved from can only be destroyed or assigned to. Two
/// threads must not use it at once.
class Simulation {
  public:
    /// Throws Error where the grains do not fit the scene, or a law is chosen for a species that is not
    /// there.
    explicit Simulation(const Scene& scene, const SimulationOptions& options = {});
    /// Goes on from a checkpoint of the same scene and with the same laws. Throws Error where there is no
    /// such file, or it is no checkpoint, damaged, of another scene, or of laws that keep another number of
    /// values. Other laws that keep as many values are not noticed.
    static Simulation from_checkpoint(const Scene& scene, const std::filesystem::path& checkpoint,
                                      const SimulationOptions& options = {});
    ~Simulation();
    Simulation(Simulation&&) noexcept;             ///< Moves.
    Simulation& operator=(Simulation&&) noexcept;  ///< Moves.

    /// Places the grains and lets them settle, if the scene says so; advance() does this too. `watcher` gets
    /// the share of the present stage that is done. If `watcher` returns false, pack() stops and returns
    /// false.
    bool pack(const std::function<bool(double)>& watcher = nullptr);

    /// Runs to the step nearest to a time (s since the drive began), and returns the time reached. It does
    /// nothing for a time that is past. Beyond the scene's duration the drive goes on. Throws Error (mistake)
    /// for a time that is no number, or so late that steps cannot be counted up to it (2^53 of them). Throws
    /// Error (failure) when something is wrong with the run: overlaps too deep, energy out of nothing, a
    /// grain out of its container.
    double advance(double time);
    /// Runs that number of steps, at least 0. Throws as advance() does.
    void advance_steps(std::int64_t steps);

    double time() const;         ///< s since the drive began.
    std::int64_t step() const;   ///< Steps since the drive began.
    bool finished() const;       ///< Whether the scene's duration is reached.
    const Scene& scene() const;  ///< The scene that is run.

    Frame frame() const;                    ///< Every grain and body now.
    std::vector<Contact> contacts() const;  ///< All that touch now, by rising `first`, then `second`.
    std::vector<Measure> measures() const;  ///< All columns of measures.csv and of the scene's instruments.
    /// The value of one column. Throws Error where the scene has no such column; the message says which
    /// instrument of output.instruments would give it.
    double measure(const std::string& column) const;
    std::vector<Field> fields() const;  ///< Means on grids now; empty where the scene asks for none.
    std::uint64_t state_hash() const;   ///< A hash of every bit on which the next steps depend.

    /// Adds grains. Returns the id of the first. Throws Error, and adds none, where one has a radius or a
    /// density that it cannot have, touches a grain, a wall or a mesh (where they are now), or lies beyond a
    /// wall or a plane, inside a closed mesh or outside a closed vessel.
    std::int32_t insert(const std::vector<NewGrain>& grains);
    /// Removes grains, by id. Throws Error where there is no such grain.
    void remove(const std::vector<std::int32_t>& ids);

    /// Writes everything that is needed to go on with the same bits. A file of that name is replaced. The
    /// folder must be there. Throws Error where the file cannot be written.
    void save_checkpoint(const std::filesystem::path& file) const;

  private:
    struct Impl;
    explicit Simulation(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel::v1
