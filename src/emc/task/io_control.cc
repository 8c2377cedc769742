// SPDX-License-Identifier: GPL-2.0-or-later
//
// io_control.cc - see io_control.hh.
#include "io_control.hh"

#include <cstdio>
#include <cstring>
#include <sstream>

#include "rcs_print.hh"

IoControl::~IoControl() {
    if (comp_ >= 0) hal_exit(comp_);
}

bool IoControl::read_change_position(const linuxcnc::IniFile &ini) {
    auto text = ini.findString("TOOL_CHANGE_POSITION", "EMCIO");
    if (!text) return true;
    std::istringstream in(*text);
    std::vector<double> v;
    for (double d; in >> d;) v.push_back(d);
    if (v.size() < 3) {
        rcs_print("bad format for TOOL_CHANGE_POSITION\n");
        return false;
    }
    v.resize(v.size() >= 9 ? 9 : v.size() >= 6 ? 6 : 3);
    tool_change_position = v;
    return true;
}

bool IoControl::create(const linuxcnc::IniFile &ini) {
    random_ = ini.findBoolV("RANDOM_TOOLCHANGER", "EMCIO", false);
    table_ = ini.findStringV("TOOL_TABLE", "EMCIO", "");
    if (!read_change_position(ini)) return false;
    std::string program = ini.findStringV("DB_PROGRAM", "EMCIO", "");
    if (tool_mmap_creator(nullptr, random_) != 0)
        rcs_print("can't create the shared tool data; other programs will see no tools\n");
    tooldata_init(random_);
    if (!program.empty()) {
        if (!table_.empty()) fprintf(stderr, "DB_PROGRAM active: IGNORING tool table file %s\n", table_.c_str());
        if (tooldata_db_init(program.c_str(), random_) == 0) {
            tooldata_set_db(DB_ACTIVE);
            database_ = true;
        } else {
            fprintf(stderr, "can't initialize DB_PROGRAM.\n");
            tooldata_set_db(DB_NOTUSED);
        }
    }
    stat_.io.aux.estop = 1;
    stat_.io.tool.pocketPrepped = -1;
    stat_.io.status = RCS_DONE;

    comp_ = hal_init("iocontrol.0");
    if (comp_ < 0) {
        rcs_print("can't make the HAL component iocontrol.0\n");
        return false;
    }
    pins_ = static_cast<Pins *>(hal_malloc(sizeof(Pins)));
    if (!pins_) return false;
    int r = 0;
    auto bit = [&](hal_pin_dir_t dir, hal_bit_t **p, const char *name) {
        r |= hal_pin_bit_newf(dir, p, comp_, "iocontrol.0.%s", name);
    };
    auto s32 = [&](hal_s32_t **p, const char *name) {
        r |= hal_pin_s32_newf(HAL_OUT, p, comp_, "iocontrol.0.%s", name);
    };
    bit(HAL_OUT, &pins_->user_enable_out, "user-enable-out");
    bit(HAL_IN, &pins_->emc_enable_in, "emc-enable-in");
    bit(HAL_OUT, &pins_->user_request_enable, "user-request-enable");
    bit(HAL_OUT, &pins_->coolant_mist, "coolant-mist");
    bit(HAL_OUT, &pins_->coolant_flood, "coolant-flood");
    s32(&pins_->tool_prep_pocket, "tool-prep-pocket");
    s32(&pins_->tool_from_pocket, "tool-from-pocket");
    s32(&pins_->tool_prep_index, "tool-prep-index");
    s32(&pins_->tool_prep_number, "tool-prep-number");
    s32(&pins_->tool_number, "tool-number");
    bit(HAL_OUT, &pins_->tool_prepare, "tool-prepare");
    bit(HAL_IN, &pins_->tool_prepared, "tool-prepared");
    bit(HAL_OUT, &pins_->tool_change, "tool-change");
    bit(HAL_IN, &pins_->tool_changed, "tool-changed");
    if (r != 0) {
        rcs_print("can't make the pins of iocontrol.0\n");
        return false;
    }
    return hal_ready(comp_) == 0;
}

void IoControl::init() {
    if (!load_file("")) rcs_print("can't load tool table.\n");
    CANON_TOOL_TABLE spindle = tooldata_entry_init();
    if (random_) {
        tooldata_get(&spindle, 0);
        stat_.io.tool.toolInSpindle = spindle.toolno;
    } else {
        stat_.io.tool.toolInSpindle = 0;
    }
    stat_.io.tool.toolFromPocket = 0;
    stat_.io.tool.pocketPrepped = -1;
    stat_.io.status = RCS_DONE;
}

void IoControl::cycle() {
    stat_.io.aux.estop = !*pins_->emc_enable_in;
    if (*pins_->emc_enable_in) *pins_->user_request_enable = 0;
    EMC_TOOL_STAT &tool = stat_.io.tool;
    if (*pins_->tool_prepare && *pins_->tool_prepared) {
        tool.pocketPrepped = *pins_->tool_prep_index;
        *pins_->tool_prepare = 0;
        stat_.io.status = RCS_DONE;
    }
    if (*pins_->tool_change && *pins_->tool_changed) {
        int idx = tool.pocketPrepped;
        CANON_TOOL_TABLE rec = tooldata_entry_init();
        if (!random_ && idx == 0) {
            tool.toolInSpindle = 0;
            tool.toolFromPocket = 0;
        } else {
            tooldata_get(&rec, idx);
            tool.toolInSpindle = rec.toolno;
            tool.toolFromPocket = rec.toolno == 0 ? 0 : rec.pocketno;
        }
        *pins_->tool_from_pocket = tool.toolFromPocket;
        *pins_->tool_number = tool.toolInSpindle;
        bool good = move_tool(idx);
        tool.pocketPrepped = -1;
        *pins_->tool_prep_number = 0;
        *pins_->tool_prep_pocket = 0;
        *pins_->tool_prep_index = 0;
        *pins_->tool_change = 0;
        stat_.io.status = good ? RCS_DONE : RCS_ERROR;
    }
}

// ---- emergency stop ----

void IoControl::estop_on() {
    *pins_->user_enable_out = 0;
    *pins_->user_request_enable = 0;
    *pins_->coolant_mist = 0;
    *pins_->coolant_flood = 0;
    *pins_->tool_prepare = 0;
    *pins_->tool_change = 0;
    *pins_->tool_prep_number = 0;
    *pins_->tool_prep_pocket = 0;
    *pins_->tool_prep_index = 0;
    *pins_->tool_from_pocket = 0;
    *pins_->tool_number = stat_.io.tool.toolInSpindle;
    stat_.io.coolant.mist = stat_.io.coolant.flood = 0;
}

void IoControl::estop_off() {
    *pins_->user_enable_out = 1;
    *pins_->user_request_enable = 1;
    stat_.io.aux.estop = 0;
}

// ---- tools ----

int IoControl::prepare(int toolno) {
    int idx = tooldata_find_index_for_tool(toolno);
    CANON_TOOL_TABLE rec = tooldata_entry_init();
    if (idx >= 0) tooldata_get(&rec, idx);
    EMC_TOOL_STAT &tool = stat_.io.tool;
    *pins_->tool_prep_index = idx;
    if (random_ && idx == 0) { // it is in the spindle
        tool.pocketPrepped = 0;
        *pins_->tool_prep_number = rec.toolno;
        *pins_->tool_prep_pocket = 0;
        return 0;
    }
    if (idx < 0) tool.pocketPrepped = -1;
    if (!random_ && idx == 0) {
        tool.pocketPrepped = 0;
        *pins_->tool_prep_number = 0;
        *pins_->tool_prep_pocket = 0;
    } else {
        *pins_->tool_prep_number = idx < 0 ? toolno : rec.toolno;
        *pins_->tool_prep_pocket = idx < 0 ? 0 : rec.pocketno;
    }
    *pins_->tool_prepare = 1;
    stat_.io.status = RCS_EXEC;
    return 0;
}

int IoControl::load() {
    EMC_TOOL_STAT &tool = stat_.io.tool;
    if (tool.pocketPrepped < 0) return 0;
    if (random_ && tool.pocketPrepped == 0) return 0;
    if (!random_ && tool.pocketPrepped > 0) {
        CANON_TOOL_TABLE rec = tooldata_entry_init();
        tooldata_get(&rec, tool.pocketPrepped);
        if (rec.toolno == tool.toolInSpindle) return 0;
    }
    *pins_->tool_change = 1;
    stat_.io.status = RCS_EXEC;
    return 0;
}

int IoControl::changing_to() const {
    const int idx = stat_.io.tool.pocketPrepped;
    if (!pins_ || !*pins_->tool_change || idx < 0) return -1;
    if (idx == 0 && !random_) return 0;
    CANON_TOOL_TABLE rec = tooldata_entry_init();
    return tooldata_get(&rec, idx) == IDX_OK && rec.toolno > 0 ? rec.toolno : 0;
}

int IoControl::unload() {
    stat_.io.tool.toolInSpindle = 0;
    *pins_->tool_number = 0;
    return 0;
}

// The record of the tool at idx comes into the spindle (index 0). False: table not saved.
bool IoControl::move_tool(int idx) {
    CANON_TOOL_TABLE spindle = tooldata_entry_init(), next = tooldata_entry_init();
    if (random_) {
        if (idx == 0) return true;
        tooldata_get(&spindle, 0);
        tooldata_get(&next, idx);
        spindle.pocketno = next.pocketno;
        next.pocketno = 0;
        tooldata_put(next, 0);
        tooldata_put(spindle, idx);
        if (database_) {
            tell_database(SPINDLE_UNLOAD, spindle.toolno, idx, spindle);
            tell_database(SPINDLE_LOAD, next.toolno, 0, next);
        }
        return save_table();
    }
    if (idx == 0) {
        spindle.toolno = 0;
        spindle.pocketno = 0;
        tooldata_put(spindle, 0);
        if (database_) tell_database(SPINDLE_UNLOAD, 0, 0, spindle);
        return true;
    }
    tooldata_get(&next, idx);
    tooldata_put(next, 0);
    if (database_) tell_database(SPINDLE_LOAD, next.toolno, 0, next);
    return true;
}

bool IoControl::save_table() {
    if (database_) return true;
    if (table_.empty()) {
        rcs_print("No filename. Are you missing INI-entry [EMCIO]TOOL_TABLE?\n");
        news_.push_back("[EMCIO]TOOL_TABLE is missing: the tools can not be saved");
        return false;
    }
    if (tooldata_save(table_.c_str()) == 0) return true;
    take_problems();
    return false;
}

// False, and the operator is told, when the program is gone: what it does not hear is lost.
bool IoControl::tell_database(tool_notify_t what, int toolno, int pocketno, const CANON_TOOL_TABLE &rec) {
    if (tooldata_db_active() && tooldata_db_notify(what, toolno, pocketno, rec) == 0) return true;
    news_.push_back("the tool database program does not answer: what happened to tool " + std::to_string(toolno) +
                    " is not kept");
    return false;
}

// One text for each problem of the tool table, for the operator.
void IoControl::take_problems() {
    constexpr int MOST = 10;
    std::istringstream in(tooldata_problems());
    int count = 0;
    for (std::string line; std::getline(in, line);)
        if (++count <= MOST) news_.push_back(line);
    if (count > MOST) news_.push_back("... and " + std::to_string(count - MOST) + " more, listed on the terminal");
}

std::vector<std::string> IoControl::news() {
    std::vector<std::string> n;
    n.swap(news_);
    return n;
}

bool IoControl::load_file(const std::string &file) {
    const std::string &name = file.empty() ? table_ : file;
    if (database_ && !tooldata_db_active()) {
        database_ = false;
        news_.push_back("the tool database program has ended: the tools are those of [EMCIO]TOOL_TABLE now");
        if (name.empty()) return false;
    }
    if (name.empty() && !database_) return true; // no table: no tools, which is not an error
    const bool good = tooldata_load(name.c_str()) == 0;
    take_problems();
    return good;
}

int IoControl::load_table(const char *file) {
    EMC_TOOL_STAT &tool = stat_.io.tool;
    CANON_TOOL_TABLE prepared = tooldata_entry_init();
    if (tool.pocketPrepped > 0) tooldata_get(&prepared, tool.pocketPrepped);
    if (!load_file(file)) {
        stat_.io.status = RCS_ERROR;
        return -1;
    }
    if (tool.pocketPrepped > 0 && prepared.toolno >= 0) { // lines may have moved: the tool counts, not its index
        tool.pocketPrepped = tooldata_find_index_for_tool(prepared.toolno);
        *pins_->tool_prep_index = tool.pocketPrepped < 0 ? 0 : tool.pocketPrepped;
        if (tool.pocketPrepped < 0) {
            *pins_->tool_prep_number = *pins_->tool_prep_pocket = 0;
            news_.push_back("tool " + std::to_string(prepared.toolno) +
                            " was prepared and is not in the table any more: call a tool again (T)");
        }
    }
    if (!random_ && stat_.io.tool.toolInSpindle != 0) {
        for (int i = 1; i <= tooldata_last_index_get(); i++) {
            CANON_TOOL_TABLE rec;
            if (tooldata_get(&rec, i) != IDX_OK || rec.toolno != stat_.io.tool.toolInSpindle) continue;
            tooldata_put(rec, 0);
            if (database_) tell_database(SPINDLE_LOAD, rec.toolno, 0, rec);
            break;
        }
    }
    stat_.io.status = RCS_DONE;
    return 0;
}

int IoControl::set_offset(const EMC_TOOL_SET_OFFSET &m) {
    // Clients name the tool and always give index 0, which is the spindle: the tool's own record
    // is the one that is kept.
    int idx = m.pocket;
    const int in_spindle = stat_.io.tool.toolInSpindle;
    const bool home_only = !random_ && idx == 0;
    CANON_TOOL_TABLE held = tooldata_entry_init();
    const bool another = random_ && idx == 0 && tooldata_get(&held, 0) == IDX_OK && held.toolno != m.toolno;
    if (home_only || another)
        for (int i = 1; i <= tooldata_last_index_get() && idx == 0; i++) {
            CANON_TOOL_TABLE other;
            if (tooldata_get(&other, i) == IDX_OK && other.toolno == m.toolno) idx = i;
        }
    if (another && idx == 0) {
        news_.push_back("tool " + std::to_string(m.toolno) + " is not in the tool table: its offsets were not set");
        stat_.io.status = RCS_DONE; // as before: nothing was changed
        return -1;
    }
    CANON_TOOL_TABLE rec = tooldata_entry_init();
    tooldata_get(&rec, idx);
    const CANON_TOOL_TABLE before = rec;
    rec.toolno = m.toolno;
    rec.offset = m.offset;
    rec.diameter = m.diameter;
    rec.frontangle = m.frontangle;
    rec.backangle = m.backangle;
    rec.orientation = m.orientation;
    if (home_only && idx > 0 && memcmp(&rec, &before, sizeof rec) == 0) { // the interpreter names both records
        if (m.toolno == in_spindle || in_spindle == 0) tooldata_put(rec, 0);
        stat_.io.status = RCS_DONE;
        return 0;
    }
    bool good = tooldata_put(rec, idx) != IDX_FAIL;
    // A fixed changer's spindle record is a copy: of its own tool it follows, as an empty one does.
    if (!random_ && idx > 0 && home_only && (m.toolno == in_spindle || in_spindle == 0)) tooldata_put(rec, 0);
    if (database_) {
        if (random_ || idx > 0) good = tell_database(TOOL_OFFSET, m.toolno, idx, rec) && good;
    } else {
        good = save_table() && good;
    }
    stat_.io.status = good ? RCS_DONE : RCS_ERROR;
    return good ? 0 : -1;
}

int IoControl::set_number(int idx) {
    CANON_TOOL_TABLE rec = tooldata_entry_init();
    if (random_ || idx != 0) tooldata_get(&rec, idx);
    else rec.toolno = 0;
    bool good = move_tool(idx);
    stat_.io.tool.toolInSpindle = rec.toolno;
    *pins_->tool_number = rec.toolno;
    if (rec.toolno == 0) {
        stat_.io.tool.toolFromPocket = 0;
        *pins_->tool_from_pocket = 0;
    }
    stat_.io.status = good ? RCS_DONE : RCS_ERROR;
    return good ? 0 : -1;
}

// ---- coolant, abort ----

int IoControl::flood(bool on) {
    stat_.io.coolant.flood = on;
    *pins_->coolant_flood = on;
    return 0;
}

int IoControl::mist(bool on) {
    stat_.io.coolant.mist = on;
    *pins_->coolant_mist = on;
    return 0;
}

void IoControl::abort(int) {
    mist(false);
    flood(false);
    *pins_->tool_change = 0;
    *pins_->tool_prepare = 0;
    stat_.io.status = RCS_DONE;
}
