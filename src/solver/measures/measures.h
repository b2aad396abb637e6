// Figures of cloths as they are: sums and maxima, which a backend finds where the cloths lie.
#pragma once

#include "solver/measures/residual.h"
#include "solver/model/cloth_model.h"

#include <span>

namespace weft {

struct MeanMax {
    double mean = 0, max = 0;
};

/// |ℓ/ℓ₀ - 1| over edges: `stretch` those along warp or weft, `shear` the others.
struct Strain {
    MeanMax stretch, shear;
};

/// Of one cloth or of several; 0 of what there is none of.
struct ClothMeasures {
    Strain strain;
    Residual residual;          ///< of the last substep
    double kinetic_energy = 0;  ///< J: ½ m v² over all particles that move
    double max_speed = 0;       ///< m/s: the fastest particle
    /// No NaN and no infinity in positions or velocities. Where there is one, the figures that it is part of are none
    /// either.
    bool finite = true;
};

/// In double: of two float positions.
double distance(Vec3 a, Vec3 b);

/// The larger one; a NaN counts as larger than all.
inline double larger(double a, double b) {
    return b > a || b != b ? b : a;
}

/// A mean and a maximum in the making.
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

/// Measures in the making, one cloth after another.
struct MeasureSums {
    Tally stretch, shear, residual;
    double kinetic_energy = 0;  ///< J
    double max_speed2 = 0;      ///< m²/s²
    bool finite = true;

    /// Positions, inverse masses and velocities of a cloth on the host: everything but the residual.
    void add(const ClothModel& model, std::span<const Vec4> positions, std::span<const Vec4> velocities);
    void add_residual(const ClothModel& model, const Residual& of_cloth);
    void add(const MeasureSums& other);
    ClothMeasures result() const;
};

}  // namespace weft
