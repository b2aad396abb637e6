// Measures of the current state of cloths: sums and maxima, which a backend computes where it stores the cloths.
#pragma once

#include "solver/measures/residual.h"
#include "solver/model/cloth_model.h"

#include <span>
#include <vector>

namespace weft {

struct MeanMax {
    double mean = 0, max = 0;
};

/// |ℓ/ℓ₀ - 1| over edges: `stretch` for edges along warp or weft, `shear` for the others.
struct Strain {
    MeanMax stretch, shear;
};

/// Measures of one or several cloths. A value with nothing to measure is 0.
struct ClothMeasures {
    Strain strain;
    Residual residual;          ///< of the last substep
    double kinetic_energy = 0;  ///< J: ½ m v² over all particles that move
    double max_speed = 0;       ///< m/s: the fastest particle
    /// No position or velocity is NaN or infinite. If one is, the values computed from it are not finite either.
    bool finite = true;
};

/// Appends what Strain::stretch is the mean and maximum of: one value per edge along warp or weft.
void collect_stretch(const ClothModel& model, std::span<const Vec4> positions, std::vector<double>& out);

/// Distance of two float positions, computed in double.
double distance(Vec3 a, Vec3 b);

/// The larger value; NaN counts as the largest.
inline double larger(double a, double b) {
    return b > a || b != b ? b : a;
}

/// Accumulates a mean and a maximum.
class Tally {
  public:
    void add(double value) { add(value, 1, value); }
    void add(double sum, double count, double max) {
        sum_ += sum;
        count_ += count;
        max_ = larger(max_, max);
    }
    void add(const Tally& other) { add(other.sum_, other.count_, other.max_); }
    MeanMax result() const { return {count_ > 0 ? sum_ / count_ : 0, max_}; }

  private:
    double sum_ = 0, count_ = 0, max_ = 0;
};

/// Accumulates measures, cloth by cloth.
struct MeasureSums {
    Tally stretch, shear, residual;
    double kinetic_energy = 0;  ///< J
    double max_speed2 = 0;      ///< m²/s²
    bool finite = true;

    /// Adds a cloth whose arrays are on the host. Adds everything but the residual.
    void add(const ClothModel& model, std::span<const Vec4> positions, std::span<const Vec4> velocities);
    void add_residual(const ClothModel& model, const Residual& of_cloth);
    void add(const MeasureSums& other);
    ClothMeasures result() const;
};

}  // namespace weft
