/// @file
/// Frames on disk: reading them from any file that the program knows, or by a reader of your own, and writing
/// them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "grainreel/frame.hpp"
#include "grainreel/world.hpp"

namespace grainreel::v1 {

/// What a file of another program does not say. docs/guide/other-programs.md explains each option.
struct ReadOptions {
    std::map<std::string, std::string> columns{};  ///< Which column means what: {"radius", "c_rad"}.
    std::optional<double> radius{};                ///< m, of all grains.
    std::optional<double> time_step{};             ///< s, of one step of the file.
    std::string units{};              ///< "lj", "si", "cgs", "micro"; empty: as the file says, else SI.
    std::optional<double> density{};  ///< kg/m3.
};

/// A file, or the folder of a run, with frames in any format that can be read. The frames come by rising
/// time.
class FrameFile {
  public:
    /// Your own readers are asked first whether they read the file, then those of the program; each looks at
    /// the file's content. Throws Error where none reads the file, or where it is damaged.
    explicit FrameFile(const std::filesystem::path& file, const ReadOptions& options = {});
    ~FrameFile();
    FrameFile(FrameFile&&) noexcept;             ///< Moves.
    FrameFile& operator=(FrameFile&&) noexcept;  ///< Moves.

    std::size_t size() const;                ///< How many frames, at least 1.
    double time(std::size_t index) const;    ///< s, of a frame; NaN where that is not known.
    std::size_t nearest(double time) const;  ///< The frame whose time is nearest, s.
    /// A frame. Throws Error where there is no frame of that number, and where it is damaged.
    Frame frame(std::size_t index) const;
    World world() const;          ///< Species and walls of triangles, as far as the file knows them.
    bool has_velocities() const;  ///< Whether the file has velocities; else they are zero.
    std::vector<std::string> news() const;  ///< What to know about the file (damage, guesses), a line each.

    /// Writes all frames in another format, one that FrameWriter knows. The file must not exist yet.
    void write(const std::filesystem::path& file, const std::string& format) const;

    /// Internal.
    struct Impl;
    /// Internal.
    const Impl& impl() const { return *impl_; }

  private:
    std::unique_ptr<Impl> impl_;
};

/// A file or a folder, and how the file begins.
struct FileHead {
    std::filesystem::path path{};  ///< As it was given.
    bool folder = false;           ///< Whether it is a folder.
    std::uintmax_t size = 0;       ///< Bytes of a file.
    std::string bytes{};           ///< The first 65536 of them.
};

/// Frames that your own reader has opened.
class FrameSource {
  public:
    virtual ~FrameSource();
    /// Species and walls. There must be a name for each number of a species that frames have.
    virtual World world() const = 0;
    /// The time of each frame, in s, rising; NaN where it is not known. There must be at least one frame.
    virtual std::vector<double> times() const = 0;
    /// A frame; its time and step need not be set. The library checks lengths, numbers and species.
    virtual Frame frame(std::size_t index) const = 0;
    /// Whether velocities are known.
    virtual bool has_velocities() const { return true; }
};

/// Reads one format. Exceptions of its functions come through as they are. If a file is damaged, throw Error
/// with the file's name.
class FrameReader {
  public:
    virtual ~FrameReader();
    virtual std::string name() const = 0;                ///< "tipsy"
    virtual std::string about() const = 0;               ///< "a snapshot of Tipsy", for messages.
    virtual bool takes(const FileHead& head) const = 0;  ///< Whether it reads this file, by the content.
    virtual std::unique_ptr<FrameSource> open(const std::filesystem::path& file) const = 0;  ///< Reads it.
};

/// From now on FrameFile asks this reader before all others. A later reader of the same name replaces it.
void add_reader(std::shared_ptr<const FrameReader> reader);

/// Names of the formats that can be written: "lammps_dump", "xyz", "vtk", ...
std::vector<std::string> written_formats();

/// Writes frames one by one.
class FrameWriter {
  public:
    /// Throws Error where the format is none of written_formats(), or the file cannot be made or exists
    /// already.
    FrameWriter(const std::filesystem::path& file, const std::string& format, const World& world);
    ~FrameWriter();                                  ///< Without close() the file may be unfinished.
    FrameWriter(FrameWriter&&) noexcept;             ///< Moves.
    FrameWriter& operator=(FrameWriter&&) noexcept;  ///< Moves.

    /// Write frames by rising time. Throws Error where the frame is not as Frame says, or the disk is full.
    void write(const Frame& frame);
    /// Finishes the file. Throws Error where that fails.
    void close();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel::v1
