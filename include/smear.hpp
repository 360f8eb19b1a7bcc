// SPDX-License-Identifier: MIT
// smear.hpp - smear.h and smear_math.h as C++11 wants them: a renderer that owns its memory, and poses that are
// composed by `*`. Header only; no exceptions, no RTTI, no allocation, nothing that C would not have done.
//
//     static smear::renderer<SMEAR_MEMORY(240, 240, 600, 8)> screen;      // width, height, triangles, draws
//
//     smear_desc desc = {};
//     desc.width = desc.height = 240, desc.max_triangles = 600, desc.max_draws = 8;
//     desc.flush = flush;
//     int result = screen.init(desc);
//
//     smear_camera camera = smear_perspective(SMEAR_DEGREES(50), SMEAR_Q16(0.1), 0);
//     for (;;) {
//         camera.pose = smear_look_at(eye, target, up);
//         screen.begin(camera, 0x203040);
//         screen.submit(1, cube, &red, smear_move(x, 0, 0) * smear_rotate_y(angle));
//         screen.render();
//     }
//
// Functions return what those of smear.h return. What is not here is called as in C, with context().
#ifndef SMEAR_HPP
#define SMEAR_HPP

#include "smear.h"
#include "smear_math.h"

// First b, then a.
inline smear_transform operator*(const smear_transform &a, const smear_transform &b)
{
    return smear_compose(a, b);
}

// Where a takes p.
inline smear_vec3 operator*(const smear_transform &a, const smear_vec3 &p)
{
    return smear_apply(a, p);
}

// Sums and differences must stay within +-32768 units.
inline smear_vec3 operator+(const smear_vec3 &a, const smear_vec3 &b)
{
    return smear_vec(a.x + b.x, a.y + b.y, a.z + b.z);
}

inline smear_vec3 operator-(const smear_vec3 &a, const smear_vec3 &b)
{
    return smear_vec(a.x - b.x, a.y - b.y, a.z - b.z);
}

inline smear_vec3 operator-(const smear_vec3 &a)
{
    return smear_vec(-a.x, -a.y, -a.z);
}

namespace smear {

// A context and its memory, of as many words of 8 bytes as SMEAR_MEMORY or `smear info --desc` says. It is large: declare
// it static, where it takes no room in flash. Calls before init() return SMEAR_ERR_ARG.
template <size_t words> class renderer {
public:
    constexpr renderer() : context_(nullptr), memory_{} {}
    renderer(const renderer &) = delete;
    renderer &operator=(const renderer &) = delete;

    int init(const smear_desc &desc)
    {
        const int result = smear_init(&context_, &desc, memory_, sizeof memory_);
        if (result != SMEAR_OK)
            context_ = nullptr;
        return result;
    }

    int begin(const smear_frame &frame) { return smear_begin(context_, &frame); }

    // Begins a frame of defaults.
    int begin(const smear_camera &camera, uint32_t clear = 0)
    {
        smear_frame frame = {};
        frame.camera = &camera;
        frame.clear = clear;
        return begin(frame);
    }

    int submit(const smear_draw &draw) { return smear_submit(context_, &draw); }

    // Submits a draw of defaults. The mesh and the material (null: white, lit) stay until render() returns; the pose is
    // copied.
    int submit(uint32_t id, const smear_mesh &mesh, const smear_material *material, const smear_transform &now)
    {
        smear_draw draw = {};
        draw.id = id;
        draw.mesh = &mesh;
        draw.material = material;
        draw.now = &now;
        return submit(draw);
    }

    int render() { return smear_render(context_); }

    smear_stats stats() const
    {
        smear_stats stats = {};
        if (context_ != nullptr)
            smear_get_stats(context_, &stats);
        return stats;
    }

    smear_context *context() { return context_; }

private:
    smear_context *context_;
    uint64_t memory_[words];
};

} // namespace smear

#endif
