// Files for tests of readers of dumps, in a folder of their own, and the messages about them.
#pragma once

#include <gmock/gmock.h>
#include <zlib.h>
#include <zstd.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.hpp"
#include "engine/files/foreign/bytes/byte_source.hpp"
#include "engine/files/foreign/raw_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {

RawFormat lammps_text_format();
RawFormat lammps_binary_format();

// The message of UserError, without the path at its beginning.
inline std::string complaint_about(const std::filesystem::path& file, const std::function<void()>& act) {
    try {
        act();
    } catch (const UserError& error) {
        const std::string message = error.what();
        EXPECT_TRUE(message.starts_with(file.string() + ":")) << message;
        return message.substr(std::min(message.size(), file.string().size()));
    }
    return "no complaint";
}

inline std::unique_ptr<RawFile> open_text(const std::filesystem::path& file) {
    EXPECT_TRUE(lammps_text_format().takes(unpacked_head(file))) << file;
    return lammps_text_format().open(file);
}

// The message when the text is opened and all its frames are read.
inline std::string text_complaint(const test::TemporaryFolder& folder, std::string_view text) {
    const std::filesystem::path file = folder.write("a.dump", text);
    return complaint_about(file, [&] {
        const std::unique_ptr<RawFile> dump = lammps_text_format().open(file);
        for (std::size_t k = 0; k < dump->moments().size(); ++k) dump->read(k);
    });
}

inline std::vector<double> column_of(const RawTable& table, const std::string& name) {
    const RawColumn* const column = table.find(name);
    if (column == nullptr) ADD_FAILURE() << "no column " << name;
    return column == nullptr ? std::vector<double>{} : column->values;
}

// A frame whose box goes from 0 to 1 along each axis.
inline std::string frame_text(const std::string& step, const std::string& count, const std::string& names,
                              const std::string& rows) {
    return "ITEM: TIMESTEP\n" + step + "\nITEM: NUMBER OF ATOMS\n" + count +
           "\nITEM: BOX BOUNDS pp pp ff\n0 1\n0 1\n0 1\nITEM: ATOMS " + names + "\n" + rows;
}

// Bytes that this process has asked the system for so far (man 5 proc).
inline std::int64_t bytes_read() {
    std::ifstream counters("/proc/self/io");
    std::string name;
    std::int64_t value = 0;
    counters >> name >> value;
    EXPECT_EQ(name, "rchar:");
    return value;
}

inline std::string gzip_of(std::string_view bytes) {
    z_stream stream{};
    EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY), Z_OK);
    std::string packed(deflateBound(&stream, bytes.size()) + 32, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    packed.resize(stream.total_out);
    deflateEnd(&stream);
    return packed;
}

inline std::string zstd_of(std::string_view bytes) {
    std::string packed(ZSTD_compressBound(bytes.size()), '\0');
    packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 3));
    return packed;
}

}  // namespace grainreel
