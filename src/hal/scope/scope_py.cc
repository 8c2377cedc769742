// SPDX-License-Identifier: GPL-2.0-or-later
//
// scope_py.cc - Python module kerf_scope: the user's side of scope_rt. [task]

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "rtapi.h"
#include "scope_shm.h"

namespace py = pybind11;

namespace {

/// The memory of scope_rt, mapped on behalf of a component of this process.
class Scope {
public:
    explicit Scope(int comp_id) : comp_id_(comp_id)
    {
        shm_id_ = rtapi_shmem_new(SCOPE_KEY, comp_id, sizeof(scope_shm));
        void *mem = nullptr;
        if (shm_id_ < 0 || rtapi_shmem_getptr(shm_id_, &mem) < 0)
            throw std::runtime_error("scope_rt: no shared memory");
        shm_ = static_cast<scope_shm *>(mem);
        if (__atomic_load_n(&shm_->magic, __ATOMIC_ACQUIRE) != SCOPE_MAGIC) {
            rtapi_shmem_delete(shm_id_, comp_id_);
            throw std::runtime_error("scope_rt is not loaded");
        }
    }
    Scope(const Scope &) = delete;
    Scope &operator=(const Scope &) = delete;
    ~Scope()
    {
        if (hal_is_init()) rtapi_shmem_delete(shm_id_, comp_id_);
    }

    unsigned buf_len() const { return shm_->buf_len; }
    int rec_len() const { return shm_->rec_len; }
    int state() const { return __atomic_load_n(&shm_->state, __ATOMIC_ACQUIRE); }
    unsigned runs() const { return __atomic_load_n(&shm_->runs, __ATOMIC_RELAXED); }
    long long period() const { return shm_->period; }
    unsigned long long count() const { return __atomic_load_n(&shm_->count, __ATOMIC_ACQUIRE); }
    void force() { __atomic_store_n(&shm_->force, 1, __ATOMIC_RELAXED); }

    void reset()
    {
        if (state() != SCOPE_IDLE && state() != SCOPE_DONE)
            __atomic_store_n(&shm_->state, SCOPE_RESET, __ATOMIC_RELEASE);
    }

    /// Where a pin, parameter ("pin", "param") or signal ("sig") has its value. It moves when a pin is
    /// linked: to be repeated now and then. Returns the type, 0 if there is none of that name.
    int source(int i, const std::string &kind, const std::string &name)
    {
        if (i < 0 || i >= SCOPE_CHANNELS) throw std::out_of_range("scope source");
        hal_query_t q = {};
        q.name = name.c_str();
        const void *cell = nullptr;
        int type = 0;
        if (kind == "sig") {
            if (hal_getref_s(&q) == 0) cell = q.sig.ref.u, type = q.sig.type;
        } else {
            q.qtype = kind == "pin" ? HAL_QTYPE_PIN : HAL_QTYPE_PARAM;
            if (hal_getref_p(&q) == 0) cell = q.pp.ref.u, type = q.pp.type;
        }
        if (type == HAL_PORT) type = 0;
        shm_->sources[i].type = type;
        shm_->sources[i].place = type ? static_cast<rtapi_u32>(hal_reference_unmap(cell)) : 0;
        return type;
    }

    /// Begins a record of rec_len samples of sample_len sources; needs IDLE or DONE.
    void start(int sample_len, int rec_len, int pre_trig, int mult, int trig_source, double level, bool rising,
               bool auto_trig, bool roll)
    {
        int now = state();
        if (now != SCOPE_IDLE && now != SCOPE_DONE) throw std::runtime_error("scope_rt is busy");
        if (sample_len < 1 || sample_len > SCOPE_CHANNELS || rec_len < 1 || pre_trig < 0 || pre_trig >= rec_len ||
            mult < 1 || static_cast<unsigned long long>(sample_len) * static_cast<unsigned>(rec_len) > shm_->buf_len)
            throw std::invalid_argument("scope settings out of range");
        shm_->sample_len = sample_len;
        shm_->rec_len = rec_len;
        shm_->pre_trig = pre_trig;
        shm_->mult = mult;
        shm_->trig_source = trig_source;
        shm_->trig_level = level;
        shm_->trig_rising = rising;
        shm_->auto_trig = auto_trig;
        shm_->roll = roll;
        __atomic_store_n(&shm_->count, 0, __ATOMIC_RELAXED);
        __atomic_store_n(&shm_->state, SCOPE_INIT, __ATOMIC_RELEASE);
    }

    /// The trigger of a running record; the next sample knows it.
    void retrigger(int trig_source, double level, bool rising, bool auto_trig)
    {
        shm_->trig_source = trig_source;
        shm_->trig_level = level;
        shm_->trig_rising = rising;
        shm_->auto_trig = auto_trig;
    }

    /// (number of the first sample, [values of each source as bytes of doubles]). While samples are
    /// taken, those that might be overwritten meanwhile are left out.
    py::tuple record()
    {
        const int len = shm_->sample_len, rec = shm_->rec_len;
        if (len < 1 || rec < 1) return py::make_tuple(0, py::list());
        const unsigned long long end = count();
        const unsigned long long oldest = end > static_cast<unsigned>(rec) ? end - static_cast<unsigned>(rec) : 0;
        std::vector<std::vector<double>> values(len);
        for (int i = 0; i < len; i++) {
            values[i].reserve(end - oldest);
            const int type = shm_->sources[i].type;
            for (unsigned long long n = oldest; n < end; n++)
                values[i].push_back(
                    scope_number(shm_->data[n % static_cast<unsigned>(rec) * static_cast<unsigned>(len) + i], type));
        }
        unsigned long long lost = 0;
        if (state() != SCOPE_DONE && state() != SCOPE_IDLE) { // the next sample may be half written already
            const unsigned long long safe =
                count() + 1 > static_cast<unsigned>(rec) ? count() + 1 - static_cast<unsigned>(rec) : 0;
            lost = std::min(end, std::max(oldest, safe)) - oldest;
        }
        py::list out;
        for (auto &v : values)
            out.append(py::bytes(reinterpret_cast<const char *>(v.data() + lost), (v.size() - lost) * sizeof(double)));
        return py::make_tuple(oldest + lost, out);
    }

private:
    int comp_id_, shm_id_ = -1;
    scope_shm *shm_ = nullptr;
};

/// For a drawing: least and greatest value in each of `columns` equal parts of the samples
/// first..last (may reach beyond the data). Returns [(column, least, greatest, first, last), ...].
std::vector<std::tuple<int, double, double, double, double>> columns(py::buffer data, double first, double last,
                                                                     int columns) {
    py::buffer_info info = data.request();
    if (info.itemsize != sizeof(double) || info.ndim != 1) throw std::invalid_argument("an array of doubles is needed");
    const double *v = static_cast<const double *>(info.ptr);
    const long long n = info.shape[0];
    std::vector<std::tuple<int, double, double, double, double>> out;
    if (columns < 1 || !(last > first)) return out;
    const double step = (last - first) / columns;
    for (int c = 0; c < columns; c++) {
        long long a = static_cast<long long>(std::ceil(first + c * step));
        long long b = static_cast<long long>(std::ceil(first + (c + 1) * step));
        a = std::max(0LL, a);
        b = std::min(n, b);
        if (a >= b) continue;
        double low = v[a], high = v[a];
        for (long long i = a + 1; i < b; i++) {
            if (v[i] < low) low = v[i];
            if (v[i] > high) high = v[i];
        }
        out.emplace_back(c, low, high, v[a], v[b - 1]);
    }
    return out;
}

/// The samples first..last (may reach beyond the data) in figures: (least, greatest, mean, period). period: samples
/// between two rises through the middle, on the average; 0 with fewer than two rises. None where there are no samples.
py::object measure(py::buffer data, double first, double last)
{
    py::buffer_info info = data.request();
    if (info.itemsize != sizeof(double) || info.ndim != 1) throw std::invalid_argument("an array of doubles is needed");
    const double *v = static_cast<const double *>(info.ptr);
    const double n = static_cast<double>(info.shape[0]);
    const long long a = static_cast<long long>(std::ceil(std::clamp(first, 0.0, n)));
    const long long b = static_cast<long long>(std::floor(std::clamp(last, -1.0, n - 1))) + 1;
    if (a >= b) return py::none();
    double low = v[a], high = v[a], sum = 0;
    for (long long i = a; i < b; i++) {
        if (v[i] < low) low = v[i];
        if (v[i] > high) high = v[i];
        sum += v[i];
    }
    const double middle = low / 2 + high / 2, noise = (high - low) / 8; // smaller changes are no rises
    long long rises = 0, from = 0, to = 0;
    bool below = false;
    for (long long i = a; i < b && high > low; i++) {
        if (v[i] < middle - noise) {
            below = true;
        } else if (below && v[i] > middle + noise) {
            below = false;
            if (rises++ == 0) from = i;
            to = i;
        }
    }
    const double period = rises > 1 ? static_cast<double>(to - from) / static_cast<double>(rises - 1) : 0.0;
    return py::make_tuple(low, high, sum / static_cast<double>(b - a), period);
}

} // namespace

PYBIND11_MODULE(kerf_scope, m)
{
    m.doc() = "The user's side of scope_rt, the realtime part of halscope.";
    m.attr("MIN_SAMPLES") = SCOPE_MIN_SAMPLES;
    m.attr("MAX_SAMPLES") = SCOPE_MAX_SAMPLES;
    m.attr("CHANNELS") = SCOPE_CHANNELS;
    m.attr("IDLE") = int(SCOPE_IDLE);
    m.attr("INIT") = int(SCOPE_INIT);
    m.attr("PRE_TRIG") = int(SCOPE_PRE_TRIG);
    m.attr("TRIG_WAIT") = int(SCOPE_TRIG_WAIT);
    m.attr("POST_TRIG") = int(SCOPE_POST_TRIG);
    m.attr("DONE") = int(SCOPE_DONE);
    m.attr("RESET") = int(SCOPE_RESET);
    m.attr("ROLL") = int(SCOPE_ROLL);
    m.def("measure", &measure, py::arg("data"), py::arg("first"), py::arg("last"));
    m.def("columns", &columns, py::arg("data"), py::arg("first"), py::arg("last"), py::arg("columns"));
    py::class_<Scope>(m, "Scope")
        .def(py::init<int>(), py::arg("comp_id"), "Maps the memory of scope_rt; RuntimeError when it is not loaded.")
        .def_property_readonly("buf_len", &Scope::buf_len, "values in the buffer")
        .def_property_readonly("rec_len", &Scope::rec_len, "samples of the record")
        .def_property_readonly("state", &Scope::state)
        .def_property_readonly("runs", &Scope::runs, "runs of scope.sample")
        .def_property_readonly("period", &Scope::period, "of its thread, ns")
        .def_property_readonly("count", &Scope::count, "samples since the start")
        .def("source", &Scope::source, py::arg("place"), py::arg("kind"), py::arg("name"))
        .def("start", &Scope::start, py::arg("sample_len"), py::arg("rec_len"), py::arg("pre_trig"), py::arg("mult"),
             py::arg("trig_source"), py::arg("level"), py::arg("rising"), py::arg("auto"), py::arg("roll"))
        .def("retrigger", &Scope::retrigger, py::arg("trig_source"), py::arg("level"), py::arg("rising"),
             py::arg("auto"))
        .def("force", &Scope::force)
        .def("reset", &Scope::reset, "no more samples")
        .def("record", &Scope::record);
}
