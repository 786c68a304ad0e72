// What an AMBER NetCDF file declares: its group, dimensions and variables, read through the netCDF library.
// The file is checked first for damage that would crash the library; survives() tries such work in a child
// process.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace grainreel {

// A variable of numbers. per_frame and per_grain tell whether it has the dimensions of frames and of grains;
// components is the size of its other dimensions.
struct AmberVariable {
    std::string name, units;
    int id = -1;
    bool per_frame = false, per_grain = false;
    std::size_t components = 1;
    bool single = true;  // it has no dimension of components, not even one of length 1
    double scale = 1;    // scale_factor
    double fill = 0;     // the value where nothing was written
};

class AmberVariables {
  public:
    // Throws UserError when the file cannot be read or has no places of grains.
    explicit AmberVariables(const std::filesystem::path& file);
    ~AmberVariables();
    AmberVariables(const AmberVariables&) = delete;
    AmberVariables& operator=(const AmberVariables&) = delete;

    std::size_t frames() const { return frames_; }      // number of whole frames in the file
    std::size_t declared() const { return declared_; }  // number of frames that its header says
    // How many frames fit into the file after a header that counts none; none where the file has no records.
    std::optional<std::size_t> records_behind_header() const;
    int count_bytes() const;                        // size of the count of records in the header, from byte 4
    std::size_t grains() const { return grains_; }  // number of places for grains in a frame
    const std::vector<AmberVariable>& variables() const { return variables_; }
    const AmberVariable* find(const std::string& name) const;
    const AmberVariable& places() const { return variables_[places_]; }
    std::string attribute(const char* name) const;  // an attribute of the file; empty where there is none

    // The numbers of the first `grains` grains in a frame, as in the file and not scaled.
    std::vector<double> read(const AmberVariable& variable, std::size_t frame, std::size_t grains) const;

  private:
    void find_group();
    void find_dimensions();
    void add_variable(int id);
    std::size_t whole_records() const;
    void check(int status) const;

    std::filesystem::path file_;
    int file_id_ = -1, id_ = -1;  // numbers of the file and the group in the library
    int frame_dimension_ = -1, atom_dimension_ = -1;
    std::size_t frames_ = 1, declared_ = 1, grains_ = 0, places_ = 0;
    std::vector<AmberVariable> variables_;
};

// Does `work` in a child process for up to so many seconds, and tells whether the child survived. This is
// needed because the HDF5 library follows pointers of a damaged file wherever they lead, and its crash must
// not end this process. What the child changed is lost. An exception counts as survival. Also returns true
// where no child can be made.
bool survives(const std::function<void()>& work, unsigned seconds);

}  // namespace grainreel
