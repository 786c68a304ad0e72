// The chunks of a GSD file (file layers 1 and 2, as the GSD specification says), whatever its schema is.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/files/foreign/byte_source.hpp"

namespace grainreel {

// A table of `rows` by `columns` values at a place of the file.
struct GsdChunk {
    std::uint64_t rows = 0, place = 0;
    std::uint32_t columns = 0;
    std::uint8_t type = 0;
};

class GsdFile {
  public:
    // Reads header, names and index. Throws UserError where the file is damaged: a chunk that lies outside it
    // or over another, a name or a type that does not exist.
    explicit GsdFile(const std::filesystem::path& file);

    const std::string& schema() const { return schema_; }
    const std::string& application() const { return application_; }
    std::size_t frames() const { return frames_; }
    const std::vector<std::string>& names() const { return names_; }
    // The chunk of that name in that frame itself; null where there is none.
    const GsdChunk* find(const std::string& name, std::size_t frame) const;
    // That some frame has one.
    bool has(const std::string& name) const { return chunks_.count(name) > 0; }

    // All values, row by row. Of a chunk of characters their codes.
    std::vector<double> numbers(const GsdChunk& chunk) const;
    // A text a row, up to its first NUL.
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
