// A film that is drawn in parts: which pictures a part draws, what its run.json says, and how the parts are
// joined. The joined film has the same bytes as one drawn in one go.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/files/frames/state_archive.hpp"
#include "engine/files/run_json.hpp"
#include "engine/run/folder/listener.hpp"
#include "render/film/production/film_maker.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/scene/film.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// The bits of encoders depend on their number of threads, so parts use the same number on all machines.
constexpr int encoder_threads_of_parts = 2;

class FilmInParts {
  public:
    // times: simulated times (s) of all pictures. Throws UserError for films that cannot be drawn in parts:
    // too few pictures, a GIF, a film with a cap, a part on stdout.
    FilmInParts(const PartsWanted& wanted, const FilmRequest& request, const FilmedScene& scene,
                std::vector<double> times);

    bool is_part() const { return wanted_.number > 0; }
    // The pictures that are drawn here, and the frames that they become.
    const FilmPart& here() const { return here_; }
    // The first picture whose frame this part must take. The trails on the part's own first picture begin
    // there. Without trails it is that picture itself.
    std::int64_t known_from() const;
    FilmExtent extent() const;
    std::string folder_name() const;  // "-part-03", which is added to the run's name
    // Warnings about side files of the film that a part does not make.
    std::vector<std::string> warnings() const;

    // The part's entry in run.json, without the checksums.
    DrawnPart record() const;

  private:
    std::vector<double> times_;
    const PartsWanted wanted_;
    const FilmedScene& scene_;
    const bool film_;
    std::vector<FilmPart> parts_;
    FilmPart here_;
};

// A checksum that is the same for parts of the same run: of scene.toml, the moments, and the grains of the
// first and the last moment that the run kept.
std::string checksum_of_run(const StateArchive& frames, const std::string& scene);
// A checksum that is the same for parts of the same film: of the scene as it is drawn, and of the moments and
// their words.
std::string checksum_of_settings(const FilmedScene& scene, const std::vector<Due>& shots,
                                 const std::vector<std::string>& captions);

struct JoinRequest {
    std::vector<std::filesystem::path> parts;  // folders, in any order
    std::filesystem::path out;                 // the film's file
    bool force = false;                        // whether a file of that name is replaced
};

// Joins the parts into one film, which has the same bytes as the film drawn in one go with --parts. Returns
// false when asked to stop. Throws UserError when parts are missing, doubled, of another run, drawn or
// encoded otherwise, incomplete or damaged, and RunError when the film cannot be written. In all these cases
// no new file gets the film's name.
bool join_parts(const JoinRequest& request, Listener& listener);

// Checks that parts in that format can be joined to the file `film`. Throws UserError when the file exists
// and may not be replaced, or has another ending.
void check_joined(const std::filesystem::path& film, FilmFormat format, bool force);

}  // namespace grainreel
