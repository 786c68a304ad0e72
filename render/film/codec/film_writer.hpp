// Pictures in, one film out. Each format has a writer; make_film_writer() chooses.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "render/picture/base/picture.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

class FilmWriter {
  public:
    // Without finish(): what was taken in is on disk in a form that plays, where the format allows that.
    virtual ~FilmWriter() = default;

    // Throws RunError, naming the file and the reason, when writing fails.
    virtual void add(const Picture& picture) = 0;
    // Pictures from here on are coded as if a film began with them: films that end and begin here can be
    // joined to this one. Throws RunError as above, and where the format has no such groups.
    virtual void begin_group();
    // Completes the film under its final name. Throws RunError as above.
    virtual void finish() = 0;

    // "H.264 in MP4: libx264 (Lavc59.37.100), crf 20, veryfast, 2 threads"
    virtual std::string description() const = 0;
    // What the user should know: "1921x1080 padded to 1922x1080: ..."
    virtual std::vector<std::string> notes() const = 0;
};

struct FilmWriterOptions {
    std::filesystem::path folder;
    bool to_stdout = false;  // y4m only: the film goes there and not into the folder
    int threads = 1;         // of the encoder
};

// "movie.webm"; empty for a film of PNG pictures, which has no file of its own.
std::string film_file_name(FilmFormat format);
// The same of a film whose writer was left without finish(): of a GIF, what it was to be made from.
std::string left_film_name(FilmFormat format);

// Creates the film's file. Null for a film of PNG pictures. Throws RunError.
std::unique_ptr<FilmWriter> make_film_writer(const FilmedScene& scene, const FilmWriterOptions& options);

// Says in words which film of the same scene has `share` of its bytes: "--size 854x480, or 180 of its 352
// frames". Bytes go with the number of frames, and with the pixels to the power 0.7 (the wedge at 640x360 and
// 1280x720, quality 24: 4 times the pixels, 2.8 times the bytes). A tenth is kept in hand.
std::string smaller_film(int width, int height, std::int64_t frames, double share);

}  // namespace grainreel
