// How strong a dashpot must be for a wanted restitution, and which restitution a dashpot gives. Damping and
// restitution have no dimension.
#pragma once

namespace grainreel {

// Linear spring and dashpot; beta = c / (2 sqrt(m k)) is the damping ratio. Where the dashpot may pull
// (attraction), the contact ends when the overlap is zero: e = exp(-pi beta / sqrt(1 - beta^2)), beta < 1.
// Without attraction it ends when the force is zero, a little earlier, so that the grains part faster
// (Schwager & Poeschel 2007, Granul. Matter 9, 465, eq. 21).
double linear_restitution(double beta, bool attraction);
double linear_damping(double restitution, bool attraction);

// Hertz' spring with the dashpot d sqrt(m k) a^(1/4) v, of overlap a, its rate v and effective mass m (Tsuji,
// Tanaka & Ishida 1992, Powder Technol. 71, 239). Its restitution does not depend on speed. Where the dashpot
// may pull, d = -sqrt(5) ln e / sqrt(pi^2 + ln^2 e) (Antypov & Elliott 2011, EPL 94, 50004). Without
// attraction the impact is integrated, and e is right to about 1e-5.
double hertz_restitution(double damping, bool attraction);
double hertz_damping(double restitution, bool attraction);

// Duration (s) of a free elastic impact with N = k a^(3/2), k in N/m^1.5. It is 2.943 a_max / v, with a_max
// = (5 m v^2 / 4k)^(2/5) (Timoshenko & Goodier, Theory of Elasticity, art. 142).
double hertz_contact_time(double mass, double k, double speed);

}  // namespace grainreel
