// See kernels.hpp. Compiled once per instruction set; only headers whose code stays in that set's namespace
// may be used. Eq. n: of [1] in docs/method.md.
#include "core/transfer/interpolation.hpp"

namespace gault::core::GAULT_ISA {
namespace {

struct Increment { // of one step: strain and rotation
    Pack xx, yy, zz, xy, cosine, sine;
};

// From H = d(dt v)/dX, the mid-step F, and the hoop strain: l = H F_mid^-1, rotation by Hughes & Winget
// (1980), strain = sym l turned from the middle of the step to its end, by half the rotation: without that,
// the stress of a body that stretches while it turns is accurate to first order only.
GAULT_INLINE Increment increment(Pack hxx, Pack hxy, Pack hyx, Pack hyy, Pack fxx, Pack fxy, Pack fyx,
                                 Pack fyy, Pack hoop) {
    const Pack inverse = Pack(1.0) / (fxx * fyy - fxy * fyx);
    const Pack lxx = (hxx * fyy - hxy * fyx) * inverse, lxy = (hxy * fxx - hxx * fxy) * inverse;
    const Pack lyx = (hyx * fyy - hyy * fyx) * inverse, lyy = (hyy * fxx - hyx * fxy) * inverse;
    const Pack half = 0.25 * (lxy - lyx); // tangent of half the angle
    const Pack scale = Pack(1.0) / (Pack(1.0) + half * half);
    const Pack cosine = (Pack(1.0) - half * half) * scale, sine = (half + half) * scale;
    const Pack shear = 0.5 * (lxy + lyx), difference = lyy - lxx;
    const Pack turn = half * half * scale * difference + sine * shear; // what xx gains and yy loses
    return {lxx + turn, lyy - turn, hoop, 0.5 * sine * difference + cosine * shear, cosine, sine};
}

GAULT_INLINE void store_increment(const BatchView& batch, int slot, const Increment& e, Pack live) {
    (e.xx * live).store(batch.strain[0] + slot);
    (e.yy * live).store(batch.strain[1] + slot);
    (e.zz * live).store(batch.strain[2] + slot);
    (e.xy * live).store(batch.strain[3] + slot);
    if (batch.rotation[0]) {
        e.cosine.store(batch.rotation[0] + slot);
        e.sine.store(batch.rotation[1] + slot);
    }
}

GAULT_INLINE void rotate_stress(const BatchView& batch, int slot, const Increment& e, bool rotate) {
    const Pack xx = Pack::load(batch.stress[0] + slot), yy = Pack::load(batch.stress[1] + slot);
    const Pack zz = Pack::load(batch.stress[2] + slot), xy = Pack::load(batch.stress[3] + slot);
    const Pack yz = Pack::load(batch.stress[4] + slot), zx = Pack::load(batch.stress[5] + slot);
    const Pack c = rotate ? e.cosine : Pack(1.0), s = rotate ? e.sine : Pack(0.0);
    const Pack turn = (s * s) * (yy - xx) + 2.0 * (c * s) * xy; // what xx gains and yy loses
    (xx + turn).store(batch.stress_old[0] + slot);
    (yy - turn).store(batch.stress_old[1] + slot);
    zz.store(batch.stress_old[2] + slot);
    (c * s * (yy - xx) + (c * c - s * s) * xy).store(batch.stress_old[3] + slot);
    (c * yz - s * zx).store(batch.stress_old[4] + slot);
    (c * zx + s * yz).store(batch.stress_old[5] + slot);
}

struct Watch { // over a batch
    Pack largest = 0.0;
    int64_t bad = -1;

    GAULT_INLINE void look(const Increment& e, Pack volume_ratio, Pack live, Pack limit, int slot) {
        const Pack size = max(max(abs(e.xx), abs(e.yy)), max(abs(e.zz), abs(e.xy))) * live;
        const Mask good = ((size < limit) & (volume_ratio > Pack(0.0))) | (live == Pack(0.0));
        largest = max(largest, size);
        if (!all(good) && bad < 0)
            for (int i = 0; i < pack_lanes; ++i)
                if (!lane(good, i) && bad < 0) bad = slot + i;
    }
    StrainReport report() const {
        double most = 0.0;
        for (int i = 0; i < pack_lanes; ++i)
            most = largest[i] > most ? largest[i] : most;
        return {most, bad};
    }
};

GAULT_INLINE void store5(double* const* to, int slot, Pack a, Pack b, Pack c, Pack d, Pack e) {
    a.store(to[0] + slot);
    b.store(to[1] + slot);
    c.store(to[2] + slot);
    d.store(to[3] + slot);
    e.store(to[4] + slot);
}

template <int DX, int DY, bool Axisymmetric>
StrainReport total_strain(const GridView& grid, const BatchView& batch, const StrainInput& in) {
    Watch watch;
    const Pack dt = in.dt, limit = in.limit, one = 1.0;
    for (int p = 0; p < batch.pages; ++p) {
        const int column = batch.column[p];
        const std::ptrdiff_t node = batch.node + column;
        for (int slot = p * page_slots; slot < (p + 1) * page_slots; slot += pack_lanes) {
            const Pack xi = Pack::load(batch.place[0] + slot);
            const auto wx = weights<DX>(grid.x, column, xi);
            const auto wy = weights<DY>(grid.y, batch.cell_row, Pack::load(batch.place[1] + slot));
            const Gathered vx = gather(in.velocity[0] + node, grid.row, wx, wy);
            const Gathered vy = gather(in.velocity[1] + node, grid.row, wx, wy);
            const Gathered ux = gather(in.displacement_old[0] + node, grid.row, wx, wy);
            const Gathered uy = gather(in.displacement_old[1] + node, grid.row, wx, wy);
            const Pack hxx = dt * vx.dx, hxy = dt * vx.dy, hyx = dt * vy.dx, hyy = dt * vy.dy;
            // F at the start of the step, and at its end.
            const Pack fxx = one + ux.dx, fxy = ux.dy, fyx = uy.dx, fyy = one + uy.dy;
            const Pack gxx = fxx + hxx, gxy = fxy + hxy, gyx = fyx + hyx, gyy = fyy + hyy;
            const Pack det = gxx * gyy - gxy * gyx;
            const Pack measure = Pack::load(batch.measure + slot);
            const Pack live = select(measure > Pack(0.0), one, 0.0);

            Pack hoop = 0.0, area = measure, stretch_old = 1.0, stretch_new = 1.0;
            if constexpr (Axisymmetric) {
                const Pack reference = Pack(grid.x.origin[column]) + xi * Pack(grid.x.length[column]);
                const Pack r = reference + ux.value, dr = dt * vx.value;
                hoop = dr / (r + 0.5 * dr);
                area = measure * (r + dr);
                if (batch.gradient_old[0] || batch.volume_ratio) {
                    stretch_old = r / reference;
                    stretch_new = (r + dr) / reference;
                }
            }
            const Increment e = increment(hxx, hxy, hyx, hyy, 0.5 * (fxx + gxx), 0.5 * (fxy + gxy),
                                          0.5 * (fyx + gyx), 0.5 * (fyy + gyy), hoop);
            watch.look(e, det, live, limit, slot);
            store_increment(batch, slot, e, live);
            rotate_stress(batch, slot, e, in.rotate);
            store5(batch.flux, slot, area * gyy, -(area * gyx), -(area * gxy), area * gxx, measure * det);
            if (batch.gradient_old[0]) {
                store5(batch.gradient_old, slot, fxx, fxy, fyx, fyy, stretch_old);
                store5(batch.gradient_new, slot, gxx, gxy, gyx, gyy, stretch_new);
            }
            if (batch.volume_ratio) (det * stretch_new).store(batch.volume_ratio + slot);
        }
    }
    return watch.report();
}

struct PlaneStress {
    Pack xx, yy, zz, xy;
};

// The stress that acts in forces: the soil's, and the viscous one of the step's strain.
GAULT_INLINE PlaneStress acting_stress(const BatchView& batch, int slot) {
    PlaneStress s{Pack::load(batch.stress[0] + slot), Pack::load(batch.stress[1] + slot),
                  Pack::load(batch.stress[2] + slot), Pack::load(batch.stress[3] + slot)};
    if (batch.viscous_shear == 0.0) return s;
    const Pack xx = Pack::load(batch.strain[0] + slot), yy = Pack::load(batch.strain[1] + slot);
    const Pack zz = Pack::load(batch.strain[2] + slot), xy = Pack::load(batch.strain[3] + slot);
    const Pack twice = 2.0 * batch.viscous_shear, volumetric = Pack(batch.viscous_lame) * (xx + yy + zz);
    s.xx += volumetric + twice * xx;
    s.yy += volumetric + twice * yy;
    s.zz += volumetric + twice * zz;
    s.xy += twice * xy;
    return s;
}

// f = - integral of P : grad N over the reference volume, with P V0 = stress . flux (Nanson's formula).
template <int DX, int DY, bool Axisymmetric>
void total_force(const GridView& grid, const BatchView& batch) {
    scatter_pages<DX, DY, 2>(batch, [&](auto& nodes, int slot, int column) GAULT_INLINE_LAMBDA {
        const auto wx = weights<DX>(grid.x, column, Pack::load(batch.place[0] + slot));
        const auto wy = weights<DY>(grid.y, batch.cell_row, Pack::load(batch.place[1] + slot));
        const auto [sxx, syy, szz, sxy] = acting_stress(batch, slot);
        const Pack axx = Pack::load(batch.flux[0] + slot), axy = Pack::load(batch.flux[1] + slot);
        const Pack ayx = Pack::load(batch.flux[2] + slot), ayy = Pack::load(batch.flux[3] + slot);
        const Pack pxx = sxx * axx + sxy * ayx, pxy = sxx * axy + sxy * ayy;
        const Pack pyx = sxy * axx + syy * ayx, pyy = sxy * axy + syy * ayy;
        Pack hoop = 0.0;
        if constexpr (Axisymmetric) hoop = szz * Pack::load(batch.flux[4] + slot);
        for (int a = 0; a <= DX; ++a) {
            Pack xs = pxx * wx.slope[a], xv = pxy * wx.value[a];
            const Pack ys = pyx * wx.slope[a], yv = pyy * wx.value[a];
            if constexpr (Axisymmetric) xs += hoop * wx.value[a];
            for (int b = 0; b <= DY; ++b) {
                nodes.sums[0][b][a] -= wy.value[b] * xs + wy.slope[b] * xv;
                nodes.sums[1][b][a] -= wy.value[b] * ys + wy.slope[b] * yv;
            }
        }
    });
}

struct Place { // of a pack in the updated frame
    Pack x, y, xi, eta;
};

GAULT_INLINE Place place(const GridView& grid, const BatchView& batch, int slot, int column) {
    const Pack x = Pack::load(batch.place[0] + slot), y = Pack::load(batch.place[1] + slot);
    return {x, y, (x - Pack(grid.x.origin[column])) * Pack(grid.x.inverse_length[column]),
            (y - Pack(grid.y.origin[batch.cell_row])) * Pack(grid.y.inverse_length[batch.cell_row])};
}

template <int DX, int DY, bool Axisymmetric>
StrainReport updated_strain(const GridView& grid, const BatchView& batch, const StrainInput& in, bool commit,
                            bool move) {
    Watch watch;
    const Pack dt = in.dt, limit = in.limit, one = 1.0;
    for (int p = 0; p < batch.pages; ++p) {
        const int column = batch.column[p];
        const std::ptrdiff_t node = batch.node + column;
        for (int slot = p * page_slots; slot < (p + 1) * page_slots; slot += pack_lanes) {
            const Place at = place(grid, batch, slot, column);
            const auto wx = weights<DX>(grid.x, column, at.xi);
            const auto wy = weights<DY>(grid.y, batch.cell_row, at.eta);
            const Gathered vx = gather(in.velocity[0] + node, grid.row, wx, wy);
            const Gathered vy = gather(in.velocity[1] + node, grid.row, wx, wy);
            const Pack volume = Pack::load(batch.measure + slot);
            // An empty slot keeps what it has.
            const Pack live = select(volume > Pack(0.0), one, 0.0), step = dt * live;
            const Pack hxx = step * vx.dx, hxy = step * vx.dy, hyx = step * vy.dx, hyy = step * vy.dy;
            const Pack dx = step * vx.value, dy = step * vy.value;
            Pack ratio = (one + hxx) * (one + hyy) - hxy * hyx, hoop = 0.0, stretch = 1.0;
            if constexpr (Axisymmetric) {
                hoop = dx / (at.x + 0.5 * dx);
                stretch = one + dx / at.x;
                ratio *= stretch;
            }
            const Increment e =
                increment(hxx, hxy, hyx, hyy, one + 0.5 * hxx, 0.5 * hxy, 0.5 * hyx, one + 0.5 * hyy, hoop);
            watch.look(e, ratio, live, limit, slot);
            store_increment(batch, slot, e, live);
            rotate_stress(batch, slot, e, in.rotate);
            if (!commit) continue;
            (volume * ratio).store(batch.measure + slot); // Eq. 13
            if (batch.deformation[0]) {
                const Pack fxx = Pack::load(batch.deformation[0] + slot),
                           fxy = Pack::load(batch.deformation[1] + slot);
                const Pack fyx = Pack::load(batch.deformation[2] + slot),
                           fyy = Pack::load(batch.deformation[3] + slot);
                const Pack fzz = Pack::load(batch.deformation[4] + slot);
                store5(batch.gradient_old, slot, fxx, fxy, fyx, fyy, fzz);
                store5(batch.gradient_new, slot, fxx + hxx * fxx + hxy * fyx, fxy + hxx * fxy + hxy * fyy,
                       fyx + hyx * fxx + hyy * fyx, fyy + hyx * fxy + hyy * fyy, fzz * stretch);
                for (int k = 0; k < 5; ++k)
                    Pack::load(batch.gradient_new[k] + slot).store(batch.deformation[k] + slot);
            }
            if (move) { // Eq. 16
                (at.x + dx).store(batch.place[0] + slot);
                (at.y + dy).store(batch.place[1] + slot);
            }
        }
    }
    return watch.report();
}

// Eq. 5 and 7; the hoop term is N / r.
template <int DX, int DY, bool Axisymmetric>
void updated_force(const GridView& grid, const BatchView& batch) {
    scatter_pages<DX, DY, 3>(batch, [&](auto& nodes, int slot, int column) GAULT_INLINE_LAMBDA {
        const Place at = place(grid, batch, slot, column);
        const auto wx = weights<DX>(grid.x, column, at.xi);
        const auto wy = weights<DY>(grid.y, batch.cell_row, at.eta);
        const Pack volume = Pack::load(batch.measure + slot), mass = Pack::load(batch.mass + slot);
        const PlaneStress s = acting_stress(batch, slot);
        const Pack sxx = volume * s.xx, syy = volume * s.yy, sxy = volume * s.xy;
        Pack hoop = 0.0;
        if constexpr (Axisymmetric) hoop = volume * s.zz / at.x;
        for (int a = 0; a <= DX; ++a) {
            Pack xs = sxx * wx.slope[a];
            const Pack xv = sxy * wx.value[a], ys = sxy * wx.slope[a], yv = syy * wx.value[a],
                       m = mass * wx.value[a];
            if constexpr (Axisymmetric) xs += hoop * wx.value[a];
            for (int b = 0; b <= DY; ++b) {
                nodes.sums[0][b][a] -= wy.value[b] * xs + wy.slope[b] * xv;
                nodes.sums[1][b][a] -= wy.value[b] * ys + wy.slope[b] * yv;
                nodes.sums[2][b][a] += wy.value[b] * m;
            }
        }
    });
}

// Eq. 10, then Eq. 5 and 6 with the updated point velocities (the MUSL re-mapping).
template <int DX, int DY>
void updated_velocity(const GridView& grid, const BatchView& batch, double step,
                      const double* const acceleration[2], const double* const velocity[2], bool scatter) {
    const Pack dt = step;
    for (int p = 0; p < batch.pages; ++p) {
        const int column = batch.column[p];
        const std::ptrdiff_t node = batch.node + column;
        for (int slot = p * page_slots; slot < (p + 1) * page_slots; slot += pack_lanes) {
            const Place at = place(grid, batch, slot, column);
            const auto wx = weights<DX>(grid.x, column, at.xi);
            const auto wy = weights<DY>(grid.y, batch.cell_row, at.eta);
            const Pack live = select(Pack::load(batch.measure + slot) > Pack(0.0), dt, 0.0);
            for (int k = 0; k < 2; ++k) {
                if (acceleration)
                    (Pack::load(batch.velocity[k] + slot) +
                     live * gather_value(acceleration[k] + node, grid.row, wx, wy))
                        .store(batch.velocity[k] + slot);
                if (velocity)
                    ((k ? at.y : at.x) + live * gather_value(velocity[k] + node, grid.row, wx, wy))
                        .store(batch.place[k] + slot);
            }
        }
    }
    if (!scatter) return;
    scatter_pages<DX, DY, 3>(batch, [&](auto& nodes, int slot, int column) GAULT_INLINE_LAMBDA {
        const Place at = place(grid, batch, slot, column);
        const auto wx = weights<DX>(grid.x, column, at.xi);
        const auto wy = weights<DY>(grid.y, batch.cell_row, at.eta);
        const Pack mass = Pack::load(batch.mass + slot);
        const Pack mx = mass * Pack::load(batch.velocity[0] + slot),
                   my = mass * Pack::load(batch.velocity[1] + slot);
        for (int a = 0; a <= DX; ++a)
            for (int b = 0; b <= DY; ++b) {
                const Pack n = wx.value[a] * wy.value[b];
                nodes.sums[0][b][a] += n * mx;
                nodes.sums[1][b][a] += n * my;
                nodes.sums[2][b][a] += n * mass;
            }
    });
}

int64_t leavers(const GridView& grid, const BatchView& batch, int64_t* slots, int64_t capacity) {
    int64_t found = 0;
    for (int p = 0; p < batch.pages; ++p)
        for (int slot = p * page_slots; slot < (p + 1) * page_slots; slot += pack_lanes) {
            const Place at = place(grid, batch, slot, batch.column[p]);
            const Pack zero = 0.0, one = 1.0;
            const Mask inside = (at.xi >= zero) & (at.xi <= one) & (at.eta >= zero) & (at.eta <= one);
            const Mask settled = inside | (Pack::load(batch.measure + slot) == zero);
            if (all(settled)) continue;
            for (int i = 0; i < pack_lanes; ++i)
                if (!lane(settled, i)) {
                    if (found < capacity) slots[found] = slot + i;
                    ++found;
                }
        }
    return found;
}

template <int DX, int DY>
void stencil(const double* const* coefficient, std::ptrdiff_t row, const double* in, double* out) {
    for (std::ptrdiff_t i = 0; i < row; i += pack_lanes) {
        Pack total = 0.0;
        const double* const* c = coefficient;
        for (int b = -DY; b <= DY; ++b)
            for (int a = -DX; a <= DX; ++a, ++c)
                total += Pack::load(*c + i) * Pack::load_unaligned(in + i + b * row + a);
        total.store(out + i);
    }
}

template <int DX, int DY, bool Axisymmetric>
constexpr Kernels table(const char* isa) {
    return {isa,
            total_strain<DX, DY, Axisymmetric>,
            total_force<DX, DY, Axisymmetric>,
            updated_strain<DX, DY, Axisymmetric>,
            updated_force<DX, DY, Axisymmetric>,
            updated_velocity<DX, DY>,
            leavers,
            stencil<DX, DY>};
}

} // namespace

constexpr const char* isa = pack_lanes == 8 ? "x86-64-v4" : pack_lanes == 4 ? "x86-64-v3" : "baseline";

const Kernels* kernels(const KernelChoice& choice) {
    static constexpr Kernels plane[2] = {table<1, 1, false>(isa), table<2, 2, false>(isa)};
    static constexpr Kernels ring[2] = {table<1, 1, true>(isa), table<2, 2, true>(isa)};
    static constexpr Kernels radial[2] = {table<1, 0, true>(isa), table<2, 0, true>(isa)};
    const auto& tables = choice.degree_y == 0 ? radial : choice.axisymmetric ? ring : plane;
    return &tables[choice.degree_x - 1];
}

} // namespace gault::core::GAULT_ISA
