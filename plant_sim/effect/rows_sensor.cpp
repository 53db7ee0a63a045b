// Catalogue: sensors.
#include "plant_sim/effect/parameter_kinds.hpp"
#include "plant_sim/effect/placed_id.hpp"

namespace levitas::effect {
namespace {

constexpr std::array kGain{Ratio(0.1, 10.0, 1.1, "reading over the nominal reading")};

constexpr std::array kReadingOffset{
    Parameter{"offset", "m", "um", -5e-3, 5e-3, 20e-6, 0.0, Scaling::kLinear, std::nullopt,
              "reading with the rotor in the magnetic centre", false}};

constexpr std::array kNonlinearity{Parameter{"a2", "1_per_m", "1_per_m", -1e6, 1e6, 500.0, 0.0,
                                             Scaling::kLinear, 0.0, "quadratic coefficient", false},
                                   Parameter{"a3", "1_per_m2", "1_per_m2", -1e10, 1e10, 5e6, 0.0,
                                             Scaling::kLinear, 0.0, "cubic coefficient", false}};

constexpr std::array kProbeBandwidth{Parameter{"bandwidth", "hz", "hz", 10.0, 1e6, 0.2, kOwn,
                                               Scaling::kGeometric, std::nullopt,
                                               "-3 dB of the first-order sensor", false}};

constexpr std::array kPosition{Parameter{"shift", "m", "mm", -1.0, 1.0, 5e-3, 0.0, Scaling::kLinear,
                                         std::nullopt,
                                         "of the sensor plane, towards the non-drive end", false}};

constexpr std::array kRunout{
    Parameter{"order", "", "", 1.0, 100.0, 1.0, 1.0, Scaling::kFixed, std::nullopt,
              "waves per turn of the measured surface", true},
    Parameter{"amplitude", "m", "um", 0.0, 1e-3, 5e-6, 0.0, Scaling::kLinear, std::nullopt,
              "of the surface", false},
    Phase("at rotor angle 0 under the x probe")};

constexpr std::array kMains{
    Parameter{"frequency", "hz", "hz", 0.1, 1e5, 50.0, 50.0, Scaling::kFixed, 50.0,
              "of the line or one of its harmonics", false},
    Parameter{"amplitude", "m", "um", 0.0, 1e-3, 2e-6, 0.0, Scaling::kLinear, std::nullopt,
              "of the reading", false},
    Phase("at plant time 0")};

constexpr std::array kNoise{
    Parameter{"rms", "m", "um", 0.0, 1e-3, 5.0, kOwn, Scaling::kLinear, std::nullopt,
              "noise of one sample", false},
    Parameter{"corner", "hz", "hz", 0.0, 1e6, 0.0, 0.0, Scaling::kFixed, 0.0,
              "above which it falls by 20 dB per decade; 0 = white", false}};

constexpr std::array kSensorRows{
    Row{Id::kSensorGain, "sensor_gain", Place::kSensor, Scope::kChannels, kGain,
        "the scale of the sensor is wrong", "reading = ratio x nominal reading",
        "every response of this channel scaled by ratio, at all frequencies",
        "ISO 14839-1; Schweitzer & Maslen 2009, Magnetic Bearings, ch. 3",
        Facts{.needs_excitation = true, .shows_in = Shows::kResponse, .modes = Modes::kOnTheLoop}},
    Row{Id::kSensorOffset, "sensor_offset", Place::kSensor, Scope::kChannels, kReadingOffset,
        "the sensor's zero is not the magnetic centre", "reading = nominal reading + offset",
        "constant (order 0) part of the reading only",
        "Schweitzer & Maslen 2009, Magnetic Bearings, ch. 3", Facts{.shows_in = Shows::kSpectrum}},
    Row{Id::kSensorNonlinearity, "sensor_nonlinearity", Place::kSensor, Scope::kChannels,
        kNonlinearity, "the characteristic of the sensor is not straight",
        "y -> y + a2 y^2 + a3 y^3",
        "of a motion of amplitude A: mean and 2nd harmonic a2 A^2/2, 3rd harmonic a3 A^3/4",
        "Schweitzer & Maslen 2009, Magnetic Bearings, ch. 3; powers of a cosine",
        Facts{.shows_in = Shows::kSpectrum}},
    Row{Id::kSensorBandwidth, "sensor_bandwidth", Place::kSensor, Scope::kChannels, kProbeBandwidth,
        "the sensor is slower or faster than nominal", "s' = 2 pi bandwidth (y - s)",
        "gain and phase of the reading above the bandwidth; static reading unchanged",
        "Schweitzer & Maslen 2009, Magnetic Bearings, ch. 3",
        Facts{.needs_excitation = true, .shows_in = Shows::kResponse, .modes = Modes::kOnTheLoop}},
    Row{Id::kSensorPosition, "sensor_position", Place::kSensor, Scope::kBearing, kPosition,
        "the sensor plane is not where the drawing says",
        "reading = sum phi_i(z_sensor + shift) q_i",
        "share of each mode in the reading; zeros move, poles stay",
        "Schweitzer & Maslen 2009, Magnetic Bearings, ch. 10 (non-collocation)",
        Facts{.shows_in = Shows::kResponse, .modes = Modes::kOnTheLoop}},
    Row{Id::kSensorRunout, "sensor_runout", Place::kSensor, Scope::kChannels, kRunout,
        "an uneven surface is read as motion; no force behind it",
        "y -> y + amplitude cos(order (angle - probe angle) + phase),  probe angle 0 or 90 degrees",
        "line at order x rotation, of constant size at every speed; order 1 turns forward, order 3 "
        "backward",
        "Kim & Lee 1997, IEEE/ASME Trans. Mechatronics 2(1) 51",
        Facts{.repeats = true, .needs_rotation = true, .shows_in = Shows::kSpectrum}},
    Row{Id::kMainsPickup, "mains_pickup", Place::kSensor, Scope::kChannels, kMains,
        "the mains or one of its harmonics is read",
        "reading + amplitude cos(2 pi frequency t + phase)",
        "line at a fixed frequency, not locked to rotation, of the same sign on all its channels",
        "Morrison & Lewis 1990, Grounding and Shielding in Facilities",
        Facts{.repeats = true, .shows_in = Shows::kSpectrum}},
    Row{Id::kSensorNoise, "sensor_noise", Place::kSensor, Scope::kChannels, kNoise,
        "level or colour of the noise differ from nominal",
        "n' = a n + sqrt(1 - a^2) rms w,  a = exp(-2 pi corner T);  white for corner 0",
        "noise floor of the reading: level rms^2, slope above the corner",
        "Kasdin 1995, Proc. IEEE 83(5) 802", Facts{.shows_in = Shows::kSpectrum}},
};

static_assert(AreAtTheirPlaces(kSensorRows));

}  // namespace

std::span<const Row> SensorRows() { return kSensorRows; }

}  // namespace levitas::effect
