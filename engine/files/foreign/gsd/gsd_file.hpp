// Reads the chunks of a GSD file with any schema (file layers 1 and 2 of the GSD specification).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/foreign/bytes/byte_source.hpp"

namespace grainreel {

// A table of rows x columns values at a place of the file.
struct GsdChunk {
    std::uint64_t rows = 0, place = 0;
    std::uint32_t columns = 0;
    std::uint8_t type = 0;
};

class GsdFile {
  public:
    // Reads header, names and index. Throws UserError where the file is damaged: a chunk lies outside the
    // file or overlaps another, or a name or a type does not exist.
    explicit GsdFile(const std::filesystem::path& file);

    const std::string& schema() const { return schema_; }
    const std::string& application() const { return application_; }
    std::size_t frames() const { return frames_; }
    const std::vector<std::string>& names() const { return names_; }
    // The chunk with that name in that frame; null where the frame has none.
    const GsdChunk* find(const std::string& name, std::size_t frame) const;
    // Whether any frame has a chunk with that name.
    bool has(const std::string& name) const { return chunks_.count(name) > 0; }

    // All values row by row. Characters are given as their codes.
    std::vector<double> numbers(const GsdChunk& chunk) const;
    // The text of each row, up to its first NUL.
    std::vector<std::string> texts(const GsdChunk& chunk) const;

    // Throws UserError "FILE: byte PLACE: what".
    [[noreturn]] void fault(std::uint64_t place, const std::string& what) const;

  private:
    struct Block;

    void read_header();
    void read_names();
    void read_index();
    void hold_apart(std::vector<Block> blocks) const;
    std::string bytes_at(std::uint64_t place, std::uint64_t size) const;

    std::filesystem::path file_;
    std::uint64_t size_ = 0;
    std::unique_ptr<ByteSource> source_;
    std::string schema_, application_;
    std::uint64_t index_place_ = 0, index_entries_ = 0, names_place_ = 0, names_size_ = 0;
    std::uint32_t layer_ = 0;
    std::vector<std::string> names_;
    std::size_t frames_ = 0;
    std::map<std::string, std::map<std::size_t, GsdChunk>> chunks_;  // by name and frame
};

}  // namespace grainreel
