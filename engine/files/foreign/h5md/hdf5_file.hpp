// An HDF5 file of another program, opened for reading: its groups, tables of numbers and attributes. Links to
// other files are not followed, and no memory is asked for because of a size that the file's bytes cannot
// hold. The HDF5 library trusts its files; so the caller tries all that is to be read in a child process
// first (hdf5_trial.hpp), and only one thread at a time may use it (hdf5_library()).
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace grainreel {

// A table of numbers (a dataset). Its file must stay open.
class Hdf5Table {
  public:
    // The lengths of its dimensions; empty for a single number. The last runs fastest.
    const std::vector<std::uint64_t>& shape() const { return shape_; }
    std::uint64_t rows() const { return shape_.empty() ? 1 : shape_.front(); }
    // The words of an enumeration, by rising value; empty for plain numbers.
    const std::vector<std::string>& words() const { return words_; }
    // The value where nothing was written.
    double fill() const { return fill_; }
    // All numbers. Those of an enumeration are places in words(). Throws UserError where they cannot be read.
    std::vector<double> numbers() const;
    // The numbers of one row of the first dimension.
    std::vector<double> row(std::uint64_t index) const;

  private:
    friend class Hdf5File;
    std::vector<double> read(std::optional<std::uint64_t> row) const;

    std::filesystem::path file_;
    std::string path_;
    std::shared_ptr<void> handle_;
    std::vector<std::uint64_t> shape_;
    std::vector<std::string> words_;
    std::vector<double> values_of_words_;
    double fill_ = 0;
};

class Hdf5File {
  public:
    // Throws UserError where the file is no HDF5 file or is cut off.
    explicit Hdf5File(const std::filesystem::path& file);

    // Paths are like "particles/all/box".
    bool has_group(const std::string& path) const;
    bool has_table(const std::string& path) const;
    // The names in a group by the alphabet.
    std::vector<std::string> names(const std::string& group) const;
    // Throws UserError where the table is missing, holds no numbers, lies in another file, or says a size
    // that this file cannot hold.
    Hdf5Table table(const std::string& path) const;
    // The words of an attribute of a group or table; empty where it is missing or holds no words.
    std::vector<std::string> words_of(const std::string& path, const std::string& attribute) const;
    std::optional<double> number_of(const std::string& path, const std::string& attribute) const;

  private:
    std::shared_ptr<void> open(const std::string& path) const;
    std::shared_ptr<void> open_attribute(const std::string& path, const std::string& attribute) const;

    std::filesystem::path file_;
    std::uint64_t size_ = 0;  // bytes
    std::shared_ptr<void> links_, handle_;
};

}  // namespace grainreel
