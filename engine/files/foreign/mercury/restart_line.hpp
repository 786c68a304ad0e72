// A line of MercuryDPM's .restart: keys, each with the words behind it, "position 0 0 1 radius 0.5".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/vector.hpp"

namespace grainreel {

class RestartLine {
  public:
    explicit RestartLine(std::string_view line);

    // The words before the first number: "TSP BP".
    const std::string& first_word() const { return first_word_; }
    // The numbers behind a key, without regard to case; of doubled keys those of the last that has `count`.
    // Null where there is none of that many.
    const std::vector<double>* find(std::string_view key, std::size_t count) const;
    std::optional<double> number(std::string_view key) const;
    std::optional<Vec3> vector(std::string_view key) const;
    // The numbers that stand behind the first words.
    const std::vector<double>& first_numbers() const;

  private:
    std::string first_word_;
    std::vector<std::pair<std::string, std::vector<double>>> entries_;  // keys in small letters
};

}  // namespace grainreel
