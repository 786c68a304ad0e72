// Damages that files suffer: bytes lost, doubled, changed; lines gone; numbers that claim too much.
#pragma once

#include <random>
#include <string>

namespace grainreel::fuzz {

// One of them, at a place of chance. The text may become longer by some 200 bytes. Never leaves it empty.
void damage(std::string& bytes, std::mt19937& random);

}  // namespace grainreel::fuzz
