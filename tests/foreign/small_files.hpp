// Small files of other programs that tests write, and what readers make of them.
#pragma once

#include <gmock/gmock.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/files/foreign/raw_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::small_files {

// A folder with one file, which is removed afterwards.
class OneFile {
  public:
    explicit OneFile(std::string_view bytes, const std::string& name = "grains") : path_(folder_ / name) {
        write(bytes);
    }
    void write(std::string_view bytes) const { test::write_text(path_, bytes); }
    void append(std::string_view bytes) const { folder_.append(path_.filename(), bytes); }
    const std::filesystem::path& path() const { return path_; }

  private:
    test::TemporaryFolder folder_;
    std::filesystem::path path_;
};

inline bool takes(const RawFormat& format, std::string_view bytes) {
    FileStart head;
    head.size = bytes.size();
    head.bytes = bytes.substr(0, kHeadBytes);
    return format.takes(head);
}

inline RawFrame frame_of(const RawFormat& format, std::string_view bytes, std::size_t index = 0) {
    const OneFile file(bytes);
    return format.open(file.path())->read(index);
}

// The message about a file, without its folder, when it is opened and all its frames are read.
inline std::string complaint_of(const RawFormat& format, std::string_view bytes) {
    const OneFile file(bytes);
    try {
        const std::unique_ptr<RawFile> opened = format.open(file.path());
        for (std::size_t i = 0; i < opened->moments().size(); ++i) opened->read(i);
    } catch (const UserError& error) {
        return std::string(error.what()).substr(file.path().parent_path().string().size() + 1);
    }
    return "no complaint";
}

inline std::string news_of(const RawFormat& format, std::string_view bytes) {
    const OneFile file(bytes);
    std::string all;
    for (const std::string& line : format.open(file.path())->news()) all += line + "\n";
    return all;
}

inline std::vector<double> column(const RawTable& table, const std::string& name) {
    for (const RawColumn& one : table.columns)
        if (one.name == name) return one.values;
    ADD_FAILURE() << "there is no column " << name;
    return {};
}

inline std::vector<std::string> words(const RawTable& table, const std::string& name) {
    for (const RawColumn& one : table.columns) {
        if (one.name != name) continue;
        std::vector<std::string> all;
        for (const double value : one.values) all.push_back(one.words.at(static_cast<std::size_t>(value)));
        return all;
    }
    ADD_FAILURE() << "there is no column " << name;
    return {};
}

inline std::vector<std::string> names(const RawTable& table) {
    std::vector<std::string> all;
    for (const RawColumn& one : table.columns) all.push_back(one.name);
    return all;
}

inline std::vector<std::int64_t> counts(const RawFormat& format, std::string_view bytes) {
    const OneFile file(bytes);
    std::vector<std::int64_t> all;
    const auto opened = format.open(file.path());
    for (const RawMoment& moment : opened->moments()) all.push_back(moment.grains);
    return all;
}

}  // namespace grainreel::small_files
