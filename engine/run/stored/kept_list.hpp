// The moments that a run kept, in one list: those of trajectory.nc, those of the film's pictures
// (film_moments.nc), and the key moments (key_moments.nc, with key_contacts.nc). A frame that is damaged, and
// a file of another run, count as not kept.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/files/contacts_file.hpp"
#include "engine/files/frames/state_archive.hpp"
#include "engine/scene/scene.hpp"

namespace grainreel {

class KeptList final : public StateArchive {
  public:
    // trajectory: the frames of trajectory.nc, in the run's folder; it must outlive this object.
    // with_keys: whether the key moments are wanted.
    KeptList(const StateArchive& trajectory, const Scene& scene, const Clock& clock, bool with_keys);

    // Index of a moment in each file that has it.
    struct Place {
        std::optional<std::size_t> trajectory, film, key;
    };
    const Place& place_of(std::size_t index) const { return places_.at(index); }
    // Index of a moment in this list; none where no file has it.
    std::optional<std::size_t> find(std::int64_t step) const;
    // The step of the nearest moment. of_trajectory: of the nearest one in trajectory.nc.
    std::int64_t nearest_step(std::int64_t step, bool of_trajectory) const;

    const std::filesystem::path& path() const override { return trajectory_.path(); }
    const StoredWorld& world() const override { return trajectory_.world(); }
    StateSupply supply() const override { return trajectory_.supply(); }
    const std::vector<State>& moments() const override { return moments_; }
    // Takes the frame from the first file that has it undamaged.
    State grains(std::size_t index) const override;
    std::optional<std::vector<Link>> touches(std::size_t index) const override;
    bool has_contacts_of(std::size_t index) const override;
    int periods() const override { return trajectory_.periods(); }

    // The moments of the film's pictures, in the order of the pictures; null where they are not used.
    const StateArchive* film() const { return film_.get(); }

    // What is wrong with a file of moments beside the trajectory.
    struct Fault {
        std::string what;    // "run/film_moments.nc: frame 3 (the first is 0) is damaged"
        bool whole = false;  // none of the file's moments is used
    };
    const std::vector<Fault>& faults_of_film() const { return film_faults_; }
    const std::vector<Fault>& faults_of_keys() const { return key_faults_; }

  private:
    void read_film();
    void read_keys();
    void check(const StateArchive& file, const std::string& name) const;
    void check_grains_at_common_step(const StateArchive& file, const std::string& name) const;
    void merge(const StateArchive& file, std::optional<std::size_t> Place::*in_file);
    std::filesystem::path file(const char* name) const { return trajectory_.path() / name; }

    const StateArchive& trajectory_;
    const Scene& scene_;
    const Clock& clock_;
    std::unique_ptr<StateArchive> film_, keys_;  // null where they are not used
    std::optional<ContactsReader> key_contacts_;
    std::vector<State> moments_;
    std::vector<Place> places_;  // one for each moment
    std::vector<Fault> film_faults_, key_faults_;
};

// Whether two frames have the same grains at the same places, as far as files keep them.
bool same_grains(const State& kept, const State& other);

}  // namespace grainreel
