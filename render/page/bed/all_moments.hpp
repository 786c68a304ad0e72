// All moments of a run that the page may show, and the film's colours of its grains. The moments are those of
// trajectory.nc, those of the film's pictures, and the run's key moments (engine/run/driver/agenda.hpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "engine/base/clock.hpp"
#include "engine/files/contacts_file.hpp"
#include "engine/files/frames/frame_archive.hpp"
#include "engine/files/frames/run_archive.hpp"
#include "render/film/sources/frame_source.hpp"
#include "render/picture/base/colour_scale.hpp"
#include "render/picture/base/shot.hpp"
#include "render/picture/grains/shown_grains.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class AllMoments final : public FrameArchive {
  public:
    // The run must outlive this object. with_contacts: the run's frames come with their contacts (touches).
    // Files beside the trajectory that are damaged or of another run are left out.
    AllMoments(const RunArchive& run, bool with_contacts);

    const std::filesystem::path& path() const override { return run_.path(); }
    const World& world() const override { return run_.world(); }
    FrameSupply supply() const override { return run_.supply(); }
    const std::vector<Frame>& moments() const override { return moments_; }
    Frame grains(std::size_t index) const override;
    int periods() const override { return run_.periods(); }

    // The touches of a moment; none when the run did not keep them.
    std::optional<std::vector<Touch>> touches(std::size_t index) const override;
    bool has_touches(std::size_t index) const;
    bool is_key(std::size_t index) const { return places_[index].key.has_value(); }
    // Sentences about files beside the trajectory that are damaged; their moments are left out.
    std::vector<std::string> news() const override { return news_; }

  private:
    struct Place {  // index of the moment in each file that has it
        std::optional<std::size_t> trajectory, film, key;
    };
    void merge(const FrameArchive& file, std::optional<std::size_t> Place::*of, const std::string& name);

    const RunArchive& run_;
    const bool with_contacts_;
    std::unique_ptr<FrameArchive> film_, keys_;
    std::optional<ContactsReader> key_contacts_;
    std::vector<Frame> moments_;
    std::vector<Place> places_;  // places of these moments in the files
    std::vector<std::string> news_;
};

// The film's colours on the page's grains: a byte for the quantity of film.colour of each grain at each
// moment.
class FilmColours {
  public:
    // For a film whose grains are coloured by a quantity (film_has_scale). start: time in s of the film's
    // first picture; a grain's start height is its height at that time. The run must outlive this object.
    FilmColours(const FilmedScene& scene, const FrameArchive& run, const Clock& clock, double start);

    // Colours of the grains at a moment of the run, in the frame's order: 0 when the quantity is not known,
    // else 1 to 255 from the low end of the film's range to its high end. If the film's scale has bands, each
    // value counts as the middle of its band. touches: those of the moment, if they are known.
    std::vector<std::uint8_t> of(std::size_t index, Shot& frame,
                                 const std::optional<std::vector<Touch>>& touches);

    bool wants_touches() const { return by_ == GrainValue::coordination || by_ == GrainValue::contact_force; }

  private:
    bool add_displacement(std::size_t index, Shot& frame) const;
    std::uint8_t byte_of(double value) const;

    const FrameArchive& run_;
    const Clock clock_;
    const GrainValue by_;
    const double depth_, frequency_;  // period of a periodic container in m; frequency of the drive in Hz
    const ColourScale scale_;
    Quantities quantities_;
};

// Whether a colour bar stands beside the film's grains.
inline bool film_has_scale(const FilmedScene& scene) {
    return scene.film.shows.colour.by != GrainValue::species;
}

}  // namespace grainreel
