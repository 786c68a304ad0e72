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
    /// If the name of the file has a number, as in "dump.5000", all files whose names differ only in it are
    /// read too, as one series. The program does this without being asked.
    bool series = false;
};

/// A file, or the folder of a run, with frames in any format that can be read. The frames come by rising
/// time.
class FrameFile {
  public:
    /// Your own readers are asked first whether they read the file, then those of the program; each looks at
    /// the file's content. A pattern ("post/dump.*") is a series of files, and so is a folder with files of
    /// another program. Throws Error where none reads the file, or where it is damaged.
    explicit FrameFile(const std::filesystem::path& file, const ReadOptions& options = {});
    ~FrameFile();
    FrameFile(FrameFile&&) noexcept;             ///< Moves.
    FrameFile& operator=(FrameFile&&) noexcept;  ///< Moves.

    std::size_t size() const;              ///< How many frames, at least 1.
    double time(std::size_t index) const;  ///< s, of a frame; NaN where the file says no times.
    /// The frame whose time is nearest, s. Throws Error where the file says no times.
    std::size_t nearest(double time) const;
    /// A frame. Throws Error where there is no frame of that number, and where it is damaged.
    Frame frame(std::size_t index) const;
    /// Species and walls, as far as the file knows them. A wall that is no mesh has no triangles; it is there
    /// so that wall k is body 2 + k. If the format keeps no title, the title is the file's name.
    World world() const;
    bool has_velocities() const;            ///< Whether the file has velocities; else they are zero.
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
    /// Whether frames have the mass of each grain.
    virtual bool has_masses() const { return false; }
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

/// Names of the formats that can be written: "netcdf", "lammps-dump", "xyz", "vtk", ... "vtk" and "blender"
/// make a folder. "lammps-data", "grain-table", "stl" and "gltf" keep the last frame only.
///
/// Formats keep what they have places for. Titles are in "netcdf", "lammps-data" and "blender" alone. "csv"
/// and "xyz" write "_" for a blank in the name of a species. "lammps-dump", "lammps-data" and "grain-table"
/// write the number of a species, from 1, and not its name.
std::vector<std::string> written_formats();

/// Writes frames one by one.
class FrameWriter {
  public:
    /// `file` is a folder for "vtk" and "blender". Throws Error where the format is none of
    /// written_formats(), where the file cannot be made or exists already, and where the world is not as
    /// World says.
    FrameWriter(const std::filesystem::path& file, const std::string& format, const World& world);
    /// Without close() the file may be unfinished. If no frame was written, no file is left.
    ~FrameWriter();
    FrameWriter(FrameWriter&&) noexcept;             ///< Moves.
    FrameWriter& operator=(FrameWriter&&) noexcept;  ///< Moves.

    /// Writes a frame. Each must be later than the one before it. If no times are known, all of them are NaN;
    /// "netcdf" does not take such frames. Steps must rise, too. If `step` is 0 in all frames, the writer
    /// numbers them 0, 1, 2, ... Either all frames with grains have orientations, or none has;
    /// so with masses.
    ///
    /// Throws Error where a frame is not so, or not as Frame says, or where the disk is full. A frame that is
    /// refused is not in the file; you may go on with others.
    void write(const Frame& frame);
    /// Finishes the file. Throws Error where that fails, or where no frame was written.
    void close();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace grainreel::v1
