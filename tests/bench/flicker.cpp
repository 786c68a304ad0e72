// How much a film flickers: the share of pixels that jump from one picture to the next.
//
//   grainreel render RUN --size 640x360 --format y4m --out - | flicker FILM_TIMES [FROM TO]...
//
// Reads a film as Y4M from stdin and looks at its grey (the luma, stretched to 0 to 255) in the middle half
// of the width. A pixel jumps if it changes by more than 25 between two neighbouring pictures. Prints the
// mean, the 90th percentile and the largest share of such pixels over the whole film, and over each stretch
// of simulated time FROM TO (s) that is named. FILM_TIMES is the film_times.csv of the run, or a dash if no
// stretch is named; the frames of a film that is drawn again have other times, so its stretches are given in
// frames: FROM TO with an f behind, 48f.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace {

constexpr double jump = 25;                    // of 255
constexpr double limited_range = 219.0 / 255;  // luma runs from 16 to 235

struct Size {
    std::size_t width = 0, height = 0;
};

[[noreturn]] void fail(const std::string& what) {
    std::cerr << "flicker: " << what << "\n";
    std::exit(2);
}

Size read_header(std::istream& in) {
    std::string line;
    if (!std::getline(in, line) || line.rfind("YUV4MPEG2", 0) != 0) fail("stdin is no Y4M film");
    Size size;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        if (line[i] != ' ') continue;
        if (line[i + 1] == 'W') size.width = std::strtoul(line.c_str() + i + 2, nullptr, 10);
        if (line[i + 1] == 'H') size.height = std::strtoul(line.c_str() + i + 2, nullptr, 10);
        if (line[i + 1] == 'C' && line.compare(i + 1, 4, "C420") != 0) fail("the film must be in 4:2:0");
    }
    if (size.width < 4 || size.height < 4) fail("the film has no size");
    return size;
}

// Reads the luma of the next picture. Returns false at the end of the film.
bool read_luma(std::istream& in, const Size& size, std::vector<unsigned char>& luma) {
    std::string line;
    if (!std::getline(in, line)) return false;
    if (line.rfind("FRAME", 0) != 0) fail("the film is damaged");
    luma.resize(size.width * size.height);
    std::vector<char> colour(2 * ((size.width + 1) / 2) * ((size.height + 1) / 2));
    in.read(reinterpret_cast<char*>(luma.data()), static_cast<std::streamsize>(luma.size()));
    in.read(colour.data(), static_cast<std::streamsize>(colour.size()));
    return static_cast<bool>(in);
}

double share_of_jumps(const Size& size, const std::vector<unsigned char>& before,
                      const std::vector<unsigned char>& now) {
    const std::size_t from = size.width / 4, to = size.width - size.width / 4;
    std::size_t jumps = 0;
    for (std::size_t y = 0; y < size.height; ++y)
        for (std::size_t x = from; x < to; ++x) {
            const std::size_t i = y * size.width + x;
            jumps += std::abs(static_cast<int>(now[i]) - static_cast<int>(before[i])) > jump * limited_range;
        }
    return static_cast<double>(jumps) / static_cast<double>((to - from) * size.height);
}

// Simulated times in s of the film's frames.
std::vector<double> read_times(const std::string& path) {
    std::ifstream in(path);
    std::string line;
    if (!std::getline(in, line)) fail("cannot read " + path);
    std::vector<double> times;
    while (std::getline(in, line)) times.push_back(std::strtod(line.c_str() + line.rfind(',') + 1, nullptr));
    return times;
}

void print(const std::string& name, std::vector<double> shares) {
    if (shares.empty()) fail(name + " has no two pictures");
    double sum = 0;
    for (const double share : shares) sum += share;
    std::sort(shares.begin(), shares.end());
    const auto rank = static_cast<std::size_t>(std::ceil(0.9 * static_cast<double>(shares.size()))) - 1;
    std::printf("%-20s %5zu pairs   mean %.3f   90th percentile %.3f   largest %.3f\n", name.c_str(),
                shares.size(), sum / static_cast<double>(shares.size()), shares[rank], shares.back());
}

}  // namespace

int main(int count, char** words) {
    if (count < 2 || count % 2 != 0) fail("flicker FILM_TIMES|- [FROM TO]... < film.y4m");
    const Size size = read_header(std::cin);
    std::vector<unsigned char> before, now;
    std::vector<double> shares;  // of each picture against the one before it
    if (!read_luma(std::cin, size, before)) fail("the film has no picture");
    while (read_luma(std::cin, size, now)) {
        shares.push_back(share_of_jumps(size, before, now));
        std::swap(before, now);
    }
    print("whole film", shares);
    const std::vector<double> times =
        std::strcmp(words[1], "-") == 0 ? std::vector<double>() : read_times(words[1]);
    for (int k = 2; k + 1 < count; k += 2) {
        const double from = std::strtod(words[k], nullptr), to = std::strtod(words[k + 1], nullptr);
        const bool by_frames = words[k][std::strlen(words[k]) - 1] == 'f';
        if (!by_frames && times.size() != shares.size() + 1)
            fail("the film has " + std::to_string(shares.size() + 1) + " pictures, but its times are " +
                 std::to_string(times.size()));
        const auto place = [&](std::size_t i) { return by_frames ? static_cast<double>(i) : times[i]; };
        std::vector<double> within;
        for (std::size_t i = 0; i < shares.size(); ++i)
            if (place(i) >= from && place(i + 1) <= to) within.push_back(shares[i]);
        print(std::string(words[k]) + " to " + words[k + 1], within);
    }
}
