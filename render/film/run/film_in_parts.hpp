// A film that is drawn in parts: which pictures a part draws, what its run.json says, and how the parts are
// joined. The joined film has the same bytes as one drawn in one go.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/files/frames/frame_archive.hpp"
#include "engine/files/run_json.hpp"
#include "engine/run/folder/listener.hpp"
#include "render/film/production/film_maker.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/film/sampling/sampler.hpp"
#include "render/film/sources/film_request.hpp"
#include "render/scene/film.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

// Encoders' bits depend on their threads: those of parts are the same on all machines.
constexpr int encoder_threads_of_parts = 2;

class FilmInParts {
  public:
    // times: s, simulated, of all pictures. Throws UserError for what cannot be had in parts: too few
    // pictures, a GIF, a film with a cap, a part on stdout.
    FilmInParts(const PartsWanted& wanted, const FilmRequest& request, const FilmedScene& scene,
                std::vector<double> times);

    bool is_part() const { return wanted_.number > 0; }
    // Those that are drawn here, and the frames that this makes.
    const FilmPart& here() const { return here_; }
    // The first picture that a part must know of: trails begin there. That of the part where it needs none.
    std::int64_t known_from() const;
    FilmExtent extent() const;
    std::string folder_name() const;  // "-part-03", to stand behind the run's name
    // What a part leaves out of the film's side files, for its user.
    std::vector<std::string> warnings() const;

    // For run.json: all but the checksums.
    DrawnPart record() const;

  private:
    std::vector<double> times_;
    const PartsWanted wanted_;
    const FilmedScene& scene_;
    const bool film_;
    std::vector<FilmPart> parts_;
    FilmPart here_;
};

// What tells parts that they are of one run: a checksum of scene.toml, the moments, and the grains of the
// first and the last moment that the run kept.
std::string checksum_of_run(const FrameArchive& frames, const std::string& scene);
// What tells parts that they are of one film: the scene as it is drawn, and which moments are drawn with
// which words.
std::string checksum_of_settings(const FilmedScene& scene, const std::vector<Shot>& shots,
                                 const std::vector<std::string>& captions);

struct JoinRequest {
    std::vector<std::filesystem::path> parts;  // folders, in any order
    std::filesystem::path out;                 // the film's file
    bool force = false;                        // a file of that name is replaced
};

// Joins the parts into one film, which has the bytes of the same film drawn in one go with --parts. False
// when asked to stop. Throws UserError with one line where parts are missing, doubled, of another run, drawn
// or encoded otherwise, incomplete or damaged; RunError when the film cannot be written. In all these cases
// nothing has the film's name that had not before.
bool join_parts(const JoinRequest& request, RunListener& listener);

// Whether parts in that format can be joined to such a file. Throws UserError where it is in the way, or has
// another ending.
void check_joined(const std::filesystem::path& film, FilmFormat format, bool force);

}  // namespace grainreel
