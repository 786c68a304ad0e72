// Writes pictures as one film. Each format has its own writer; make_film_writer() chooses it.
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
    // If finish() was not called: leaves the pictures that were added on disk, in a form that plays if the
    // format allows it.
    virtual ~FilmWriter() = default;

    // Adds a picture. Throws RunError, naming the file and the reason, when writing fails.
    virtual void add(const Picture& picture) = 0;
    // Codes the pictures from here on as if a film began with them, so that parts of a film that was cut here
    // can be joined. Throws RunError as above, and if the format has no such groups.
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
    bool to_stdout = false;  // y4m only: the film goes to stdout and not into the folder
    int threads = 1;         // threads of the encoder
};

// "movie.webm"; empty for a film of PNG pictures, which has no file of its own.
std::string film_file_name(FilmFormat format);
// The name of the file that is left when finish() was not called. For a GIF this is the copy that the GIF
// would have been made from.
std::string left_film_name(FilmFormat format);

// Creates the film's file. Null for a film of PNG pictures. Throws RunError.
std::unique_ptr<FilmWriter> make_film_writer(const FilmedScene& scene, const FilmWriterOptions& options);

// Says in words which film of the same scene would have `share` of its bytes: "--size 854x480, or 180 of its
// 352 frames". The bytes are taken to grow with the number of frames, and with the pixels to the power 0.7.
// (The wedge at quality 24 has 2.8 times the bytes at 1280x720 that it has at 640x360, for 4 times the
// pixels.) A tenth is kept as a margin.
std::string smaller_film(int width, int height, std::int64_t frames, double share);

}  // namespace grainreel
