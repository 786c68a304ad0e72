// All moments of a run that its folder has: those of trajectory.nc, those of the film's pictures, and its key
// moments.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "engine/files/contacts_file.hpp"
#include "engine/files/frames/run_archive.hpp"

namespace grainreel {

class AllMoments final : public FrameArchive {
  public:
    // The run outlives it. with_contacts: its frames come with touches. Files beside the trajectory that are
    // damaged or of another run are left out.
    AllMoments(const RunArchive& run, bool with_contacts);

    const std::filesystem::path& path() const override { return run_.path(); }
    const World& world() const override { return run_.world(); }
    FrameSupply supply() const override { return run_.supply(); }
    const std::vector<Frame>& moments() const override { return moments_; }
    Frame grains(std::size_t index) const override;
    int periods() const override { return run_.periods(); }

    // None where the run did not keep it.
    std::optional<std::vector<Touch>> touches(std::size_t index) const override;
    bool has_touches(std::size_t index) const;
    bool is_key(std::size_t index) const { return places_[index].key.has_value(); }
    // Sentences about files beside the trajectory that are damaged; their moments are left out.
    std::vector<std::string> news() const override { return news_; }

  private:
    struct Place {  // in each of the files that has the moment
        std::optional<std::size_t> trajectory, film, key;
    };
    void merge(const FrameArchive& file, std::optional<std::size_t> Place::*of, const std::string& name);

    const RunArchive& run_;
    const bool with_contacts_;
    std::unique_ptr<FrameArchive> film_, keys_;
    std::optional<ContactsReader> key_contacts_;
    std::vector<Frame> moments_;
    std::vector<Place> places_;  // of each
    std::vector<std::string> news_;
};

}  // namespace grainreel
