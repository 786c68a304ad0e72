#include "engine/handover/drive_formula.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "engine/base/mathematics.hpp"
#include "engine/scene/drive_schedule.hpp"

namespace grainreel {

std::string peer_number(double value) {
    const std::string text = fmt::format("{}", value);
    return value < 0 ? "(" + text + ")" : text;
}

namespace {

using std::numbers::pi;

// Collects the variables of a formula. Each stretch of the drive adds a part to the last three variables,
// which counts only in its own time.
class FormulaWriter {
  public:
    explicit FormulaWriter(const Drive& drive) : drive_(drive) { formula_.direction = drive.direction; }

    void one_stage(double until);
    void stretch(std::size_t number, const PeriodStretch& times, const DriveSchedule::Piece& piece,
                 double until);
    DriveFormula finish();

  private:
    std::string number(double value) const { return peer_number(value); }
    std::string add(const std::string& name, const std::string& expression) {
        formula_.variables.push_back({name, expression});
        return "v_" + name;
    }
    // An expression that is 1 between two times (s) and 0 else.
    std::string gate(const std::string& name, double from, double until) {
        const std::string begun = from > 0 ? fmt::format("(v_t>={})", number(from)) : "1.0";
        if (std::isinf(until)) return from > 0 ? add(name, begun) : "1.0";
        return add(name, from > 0 ? fmt::format("{}*(v_t<{})", begun, number(until))
                                  : fmt::format("(v_t<{})", number(until)));
    }
    void part(const std::string& on, const std::string& shift, const std::string& speed,
              const std::string& ride) {
        const std::string stem = fmt::format("p{}", parts_++);
        shift_ += (shift_.empty() ? "" : "+") + add(stem + "s", on + "*(" + shift + ")");
        speed_ += (speed_.empty() ? "" : "+") + add(stem + "v", on + "*(" + speed + ")");
        ride_ += (ride_.empty() ? "" : "+") + add(stem + "a", on + "*(" + ride + ")");
    }
    // A sine with constant amplitude and frequency. phase (rad) is an expression.
    void sine(const std::string& on, double amplitude, double frequency, const std::string& phase) {
        const double w = 2 * pi * frequency;
        const std::string start = drive_.ramp > 0 ? "" : "-" + number(math::sin(2 * pi * drive_.phase));
        part(on, fmt::format("{}*(sin({}){})", number(amplitude), phase, start),
             fmt::format("{}*cos({})", number(amplitude * w), phase),
             fmt::format("{}*sin({})", number(amplitude * w * w), phase));
    }
    void change(const std::string& stem, const std::string& on, const PeriodStretch& times,
                const DriveSchedule::Piece& piece);
    void tap(const std::string& stem, const std::string& on, double start, const DriveSchedule::Piece& piece);
    // Time since a moment, and 0 before it.
    std::string since(double start) const {
        return start > 0 ? fmt::format("((v_t>{0})*(v_t-{0}))", number(start)) : "v_t";
    }

    Drive drive_;
    DriveFormula formula_;
    int parts_ = 0;
    std::string shift_, speed_, ride_;
};

// z = a s sin(wt + phi), with the ramp s(u), u = f t / ramp. Without a ramp, z at the start is subtracted.
void FormulaWriter::one_stage(double until) {
    const double a = drive_.amplitude, f = drive_.frequency, w = 2 * pi * f;
    const std::string on = gate("on0", 0, until);
    const std::string phase =
        add("phase0", fmt::format("{}*v_t+{}", number(w), number(2 * pi * drive_.phase)));
    if (!(drive_.ramp > 0)) {
        sine(on, a, f, phase);
        return;
    }
    const double rate = f / drive_.ramp;
    const std::string u = add("u", fmt::format("v_t*{}", number(rate)));
    const std::string s =
        add("s", fmt::format("({0}>=1.0)+({0}<1.0)*{0}*{0}*{0}*(10.0+{0}*(6.0*{0}-15.0))", u));
    const std::string ds =
        add("ds", fmt::format("({0}<1.0)*30.0*{0}*{0}*(1.0-{0})*(1.0-{0})*{1}", u, number(rate)));
    const std::string dds =
        add("dds", fmt::format("({0}<1.0)*60.0*{0}*(1.0-{0})*(1.0-2.0*{0})*{1}", u, number(rate * rate)));
    part(on, fmt::format("{}*{}*sin({})", number(a), s, phase),
         fmt::format("{0}*({1}*{2}*cos({3})+{4}*sin({3}))", number(a), s, number(w), phase, ds),
         fmt::format("{0}*(({1}*{2}-{3})*sin({4})-{5}*{6}*cos({4}))", number(a), s, number(w * w), dds, phase,
                     ds, number(2 * w)));
}

// The formulas of DriveChange: frequency and acceleration change as s(u), and the amplitude follows from
// them.
void FormulaWriter::change(const std::string& stem, const std::string& on, const PeriodStretch& times,
                           const DriveSchedule::Piece& piece) {
    const double w0 = 2 * pi * piece.frequency_before,
                 more = 2 * pi * (piece.frequency - piece.frequency_before);
    const double level0 = piece.acceleration_before, growth = piece.acceleration - piece.acceleration_before;
    const double f0 = 1 / times.period, f1 = 1 / times.period_after, length = times.length;
    const auto name = [&](const char* part) { return stem + part; };
    const std::string x = add(name("x"), fmt::format("{}/{}", since(times.start), number(length)));
    const std::string u = add(name("u"), fmt::format("({0}<1.0)*{0}+({0}>=1.0)", x));
    const std::string s = add(name("s"), fmt::format("{0}*{0}*{0}*(10.0+{0}*(6.0*{0}-15.0))", u));
    const std::string ds =
        add(name("ds"), fmt::format("30.0*{0}*{0}*(1.0-{0})*(1.0-{0})*{1}", u, number(1 / length)));
    const std::string dds = add(
        name("dds"), fmt::format("60.0*{0}*(1.0-{0})*(1.0-2.0*{0})*{1}", u, number(1 / (length * length))));
    // Number of periods since its start: the integral of f.
    const std::string phase =
        add(name("p"),
            fmt::format("{0}*({1}*{2}+{3}*{2}*{2}*{2}*{2}*(2.5+{2}*({2}-3.0)))+{4}", number(2 * pi),
                        number(f0 * length), u, number((f1 - f0) * length), number(2 * pi * drive_.phase)));
    const std::string w = add(name("w"), fmt::format("{}+{}*{}", number(w0), number(more), s));
    const std::string l = add(name("l"), fmt::format("{}+{}*{}", number(level0), number(growth), s));
    const std::string dl = add(name("dl"), fmt::format("{}*{}", number(growth), ds));
    const std::string ddl = add(name("ddl"), fmt::format("{}*{}", number(growth), dds));
    const std::string g = add(name("g"), fmt::format("{}*{}/{}", number(more), ds, w));  // w' / w
    const std::string h = add(name("h"), fmt::format("{}*{}/{}", number(more), dds, w));
    const std::string a = add(name("a"), fmt::format("{0}/({1}*{1})", l, w));
    const std::string da = add(name("da"), fmt::format("({0}-2.0*{1}*{2})/({3}*{3})", dl, l, g, w));
    const std::string dda =
        add(name("dda"),
            fmt::format("({0}-4.0*{1}*{2}+{3}*(6.0*{2}*{2}-2.0*{4}))/({5}*{5})", ddl, dl, g, l, h, w));
    const double start = drive_.ramp > 0 ? 0 : math::sin(2 * pi * drive_.phase);
    const std::string sine = add(name("n"), fmt::format("sin({})-{}", phase, number(start)));
    // z = a n, with n = sin p - sin phi: z'' = a'' n + 2 a' w cos p + a (w' cos p - w^2 sin p).
    part(on, fmt::format("{}*{}", a, sine), fmt::format("{}*{}+{}*{}*cos({})", da, sine, a, w, phase),
         fmt::format("{0}*{1}*{1}*sin({2})-{3}*{4}-(2.0*{5}+{0}*{6})*{1}*cos({2})", a, w, phase, dda, sine,
                     da, g));
}

// z = a (1 - cos wt): once up and down, and then at rest until the next tap.
void FormulaWriter::tap(const std::string& stem, const std::string& on, double start,
                        const DriveSchedule::Piece& piece) {
    const double w = 2 * pi * piece.frequency, a = piece.acceleration / (w * w);
    const std::string late = add(stem + "l", since(start));
    const std::string within =
        add(stem + "i", fmt::format("{0}-{1}*floor({0}/{1})", late, number(piece.interval)));
    const std::string going =
        add(stem + "g", fmt::format("{}*({}<{})", on, within, number(1 / piece.frequency)));
    part(going, fmt::format("{}*(1.0-cos({}*{}))", number(a), number(w), within),
         fmt::format("{}*sin({}*{})", number(a * w), number(w), within),
         fmt::format("{}*cos({}*{})", number(-a * w * w), number(w), within));
}

void FormulaWriter::stretch(std::size_t number_of, const PeriodStretch& times,
                            const DriveSchedule::Piece& piece, double until) {
    if (!(until > times.start) || piece.kind == DriveStage::Kind::rest) return;
    const std::string stem = fmt::format("c{}", number_of);
    const std::string on = gate(fmt::format("on{}", number_of), times.start, until);
    if (times.changes()) {
        change(stem, on, times, piece);
    } else if (piece.kind == DriveStage::Kind::taps) {
        tap(stem, on, times.start, piece);
    } else {
        const double w = 2 * pi * piece.frequency;
        const std::string phase = add(stem + "p", fmt::format("{}*{}+{}", number(w), since(times.start),
                                                              number(2 * pi * drive_.phase)));
        sine(on, piece.acceleration / (w * w), piece.frequency, phase);
    }
}

DriveFormula FormulaWriter::finish() {
    const auto none = [](const std::string& sum) { return sum.empty() ? std::string("0.0") : sum; };
    add("shift", none(shift_));
    add("speed", none(speed_));
    add("ride", none(ride_));
    return formula_;
}

}  // namespace

DriveFormula drive_formula(const Drive& drive) {
    if (!drive.present || !(drive.largest_amplitude() > 0)) return {};
    FormulaWriter writer(drive);
    if (!drive.changes()) {
        writer.one_stage(std::numeric_limits<double>::infinity());
        return writer.finish();
    }
    const DriveSchedule schedule(drive);
    const std::vector<PeriodStretch>& times = schedule.times().stretches();
    for (std::size_t i = 0; i < times.size(); ++i) {
        const double until =
            i + 1 < times.size() ? times[i + 1].start : std::numeric_limits<double>::infinity();
        if (i == 0 && until > 0)
            writer.one_stage(until);
        else
            writer.stretch(i, times[i], schedule.pieces()[i], until);
    }
    return writer.finish();
}

PeerVariable time_variable(std::int64_t shift) {
    if (shift == 0) return {"t", "step*dt"};
    return {"t", fmt::format("(step>{0})*(step-{0})*dt", shift)};
}

// The rate is a smooth step that begins at `from`, minus one that begins at `until`. The angle is its
// integral.
TurnFormula turn_formula(const BodyTurn& turn) {
    const auto share = [&](double begin) {
        const std::string past = fmt::format("(v_t>={})", peer_number(begin));
        if (!(turn.over > 0)) return past;
        const std::string x = fmt::format("((v_t-{})/{})", peer_number(begin), peer_number(turn.over));
        return fmt::format("{0}*(({1}>=1.0)+({1}<1.0)*{1}*{1}*{1}*(10.0+{1}*(6.0*{1}-15.0)))", past, x);
    };
    const auto integral = [&](double begin) {
        const std::string late = fmt::format("(v_t-{})", peer_number(begin));
        const std::string past = fmt::format("(v_t>={})", peer_number(begin));
        if (!(turn.over > 0)) return past + "*" + late;
        const std::string x = late + "/" + peer_number(turn.over);
        return fmt::format(
            "{0}*((({1})>=1.0)*({2}-{3})+(({1})<1.0)*{4}*({1})*({1})*({1})*({1})*(2.5+({1})*(({1})-3.0)))",
            past, x, late, peer_number(0.5 * turn.over), peer_number(turn.over));
    };
    std::string angle = integral(turn.from), rate = share(turn.from);
    if (std::isfinite(turn.until)) {
        angle += "-" + integral(turn.until);
        rate += "-" + share(turn.until);
    }
    return {fmt::format("{}*({})", peer_number(turn.rate), angle),
            fmt::format("{}*({})", peer_number(turn.rate), rate)};
}

}  // namespace grainreel
