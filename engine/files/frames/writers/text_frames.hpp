// What writers of text share: a file that says when the disk is full, and the box around a frame.
#pragma once

#include <filesystem>
#include <string>

#include "engine/base/plain_file.hpp"
#include "engine/files/frames/world.hpp"
#include "engine/frame.hpp"

namespace grainreel {

// Text that is written in pieces of some MB.
class TextPieces {
  public:
    explicit TextPieces(const std::filesystem::path& path) : file_(path) {}

    std::string& text() { return text_; }
    // Writes where much has gathered.
    void pass() {
        if (text_.size() > (std::size_t{1} << 22)) flush();
    }
    void flush() {
        file_.write(text_);
        text_.clear();
    }

  private:
    TextFile file_;
    std::string text_;
};

// The world's cell along its periodic edges, and else what holds all grains of the frame, whole.
WorldCell box_of(const World& world, const Frame& frame);

// The name of a species without blanks, for formats that part words by them.
std::string one_word(const std::string& name);

}  // namespace grainreel
