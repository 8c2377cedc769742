/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * stages.hh - the functions of the interpreter's stages, by file.
 *
 * All take the state first. An int result is an InterpReturn.
 */
#ifndef KERF_STAGES_HH
#define KERF_STAGES_HH

#include "setup.hh"

namespace ngc
{

// ---- text.cc: raw line -> canonical text ------------------------------------------
/// Copies a line into s.raw and s.text.
[[nodiscard]] int take_line(Setup &s, std::string_view line);
/// Column (from 1) in s.raw of a place in s.text.
int raw_column(const Setup &s, int text_pos);
void fill_fault_place(Setup &s);

// ---- expressions.cc: text -> values, at s.pos ----------------------------------------
[[nodiscard]] int read_real(Setup &s, double *value);
[[nodiscard]] int read_integer(Setup &s, int *value);
[[nodiscard]] int read_bracketed(Setup &s, double *value);
[[nodiscard]] int read_parameter_name(Setup &s, std::string_view *name);
[[nodiscard]] int to_integer(Setup &s, double value, int *result);
/// The int nearest to a whole number of any size: beyond the range of int every use of it is out of range, too.
constexpr int saturated(double whole)
{
    return whole >= 2147483647.0 ? 2147483647 : whole <= -2147483648.0 ? -2147483647 - 1 : int(whole);
}

// ---- interp.cc: modes as at the start; the next line of the program -> block (empty when it is skipped)
void init_modes(Setup &s);
[[nodiscard]] int read_next_block(Setup &s);
/// Executes a line in the middle of a block, with all that it calls (for Python's self.execute()).
[[nodiscard]] int run_inner(Setup &s, const char *text);

// ---- words.cc: text -> block -----------------------------------------------------------
[[nodiscard]] int read_block(Setup &s);

// ---- oword_read.cc: an O line, or M98/M99, -> block ---------------------------------------
[[nodiscard]] int read_oword(Setup &s);
bool at_fanuc_word(const Setup &s);

// ---- inference.cc, checks.cc: block -> checked block ----------------------------------------
[[nodiscard]] int infer_motion(Setup &s);
[[nodiscard]] int check_block(Setup &s);

// ---- execute.cc: block -> effects -----------------------------------------------------------
[[nodiscard]] int execute_block(Setup &s);

// ---- oword_run.cc: flow -------------------------------------------------------------------------
[[nodiscard]] int execute_oword(Setup &s);
[[nodiscard]] int run_call(Setup &s);
[[nodiscard]] int run_return(Setup &s);
/// A call level of its own, its arguments from s.block; the caller goes on behind its line.
[[nodiscard]] int enter_sub(Setup &s, CallType type, const std::string &name);
/// The next line read will be (on the way to) that sub.
[[nodiscard]] int seek_sub(Setup &s, const std::string &name);
void leave_frame(Setup &s);
[[nodiscard]] int finish_python_sub(Setup &s, int status);
void unwind(Setup &s);
void clear_labels(Setup &s);

// ---- subfiles.cc: which file holds a sub ---------------------------------------------------------
/// Path of NAME.ngc in the documented search order; empty when there is none.
std::string find_sub_file(const Setup &s, const std::string &name);
/// Opens a program (as it was at first) or a called file. now: as it is now. False: errno says why.
bool open_file(Setup &s, LineSource &file, const std::string &path, bool now = false);
/// Of s.sources: what is to be read by a call from here.
bool is_current(Setup &s, int i);
/// Index in s.sources of an opened file, -1 with errno.
int open_source(Setup &s, const std::string &path);
std::string expand_path(const std::string &path);

// ---- parameters.cc, named.cc --------------------------------------------------------------------
[[nodiscard]] int parameter_value(Setup &s, int index, double *value);
/// The value without checks; for comments and listings. index 1..5601
double parameter_now(const Setup &s, int index);
bool parameter_read_only(int index);
/// Finds in locals, globals, INI and HAL. False: there is none (s.error may say why).
bool named_value(Setup &s, std::string_view name, double *value, bool *failed = nullptr);
NamedParameter &make_named(Setup &s, std::string_view name);
NamedParameter *find_named(Setup &s, std::string_view name);
void define_predefined(Setup &s);
[[nodiscard]] int store_settings(Setup &s);

// ---- varfile.cc ------------------------------------------------------------------------------------
[[nodiscard]] int load_parameters(Setup &s);
[[nodiscard]] int save_parameters(Setup &s);

// ---- comments.cc --------------------------------------------------------------------------------------
[[nodiscard]] int execute_comment(Setup &s, std::string_view text);

// ---- effects of the words and codes ------------------------------------------------------------------------
[[nodiscard]] int convert_spindle_mode(Setup &s);   // spindle.cc
[[nodiscard]] int convert_feed_mode(Setup &s);      // feed.cc
[[nodiscard]] int convert_feed_rate(Setup &s);
[[nodiscard]] int convert_speed(Setup &s);          // spindle.cc
[[nodiscard]] int convert_spindle_codes(Setup &s, int m);
[[nodiscard]] int convert_tool_select(Setup &s);    // tools.cc
[[nodiscard]] int convert_tool_change(Setup &s);
[[nodiscard]] int convert_tool_number(Setup &s);
[[nodiscard]] int convert_tool_length(Setup &s, int g);
[[nodiscard]] int convert_tool_data(Setup &s);      // G10 L0 L1 L10 L11
[[nodiscard]] int retain_g43(Setup &s);
int tool_index(const Setup &s, int toolno);         // -1: not there
void load_tool_table(Setup &s);
void set_tool_parameters(Setup &s);
[[nodiscard]] int convert_io(Setup &s, int m);      // io.cc
[[nodiscard]] int convert_coolant(Setup &s, int m);
[[nodiscard]] int convert_override(Setup &s, int m);
[[nodiscard]] int convert_user_m(Setup &s);
[[nodiscard]] int convert_plane(Setup &s, int g);   // modes.cc
[[nodiscard]] int convert_units(Setup &s, int g);
[[nodiscard]] int convert_lathe(Setup &s, int g);
[[nodiscard]] int convert_control_mode(Setup &s, int g);
[[nodiscard]] int convert_distance(Setup &s, int g);
[[nodiscard]] int convert_ijk(Setup &s, int g);
[[nodiscard]] int convert_retract(Setup &s, int g);
void exact_moves(Setup &s, bool on); // for a while, whatever path mode the program has set
[[nodiscard]] int convert_comp(Setup &s, int g);    // comp.cc
[[nodiscard]] int comp_off(Setup &s);
[[nodiscard]] int convert_coord_system(Setup &s, int g); // offsets.cc
[[nodiscard]] int convert_offset_data(Setup &s);    // G10 L2 L20
[[nodiscard]] int convert_g92(Setup &s, int g);
[[nodiscard]] int convert_group0(Setup &s, int g);  // group0.cc
[[nodiscard]] int convert_home(Setup &s, int g);
[[nodiscard]] int store_home(Setup &s, int g);
[[nodiscard]] int convert_motion(Setup &s, int g);  // motion.cc
[[nodiscard]] int convert_straight(Setup &s, int g);
[[nodiscard]] int convert_probe(Setup &s, int g);
[[nodiscard]] int convert_spindle_synched(Setup &s, int g); // G33 G33.1
[[nodiscard]] int convert_arc(Setup &s, int g);     // arc.cc
[[nodiscard]] int convert_cycle(Setup &s, int g);   // cycles.cc
[[nodiscard]] int convert_g76(Setup &s);            // g76.cc
[[nodiscard]] int convert_g7x(Setup &s, int g);     // g7x.cc
[[nodiscard]] int convert_spline(Setup &s, int g);  // nurbs.cc
[[nodiscard]] int convert_nurbs_point(Setup &s, int g);
[[nodiscard]] int convert_nurbs_end(Setup &s);
[[nodiscard]] int convert_nurbs_g6(Setup &s, int g);
void nurbs_forget(Setup &s);
[[nodiscard]] int convert_stop(Setup &s, int m);    // stop.cc
[[nodiscard]] int save_modes(Setup &s, bool restore_on_return); // context.cc
[[nodiscard]] int restore_modes(Setup &s, const SavedModes &from);

// ---- geometry shared by motions (ends.cc) -----------------------------------------------------------------------
/// End point of the block's words, by distance mode, polar words, G53, wrapped axes.
[[nodiscard]] int find_ends(Setup &s, const Block &b, EmcPose *end);
/// The current point in machine coordinates (all offsets), program units.
EmcPose absolute_position(const Setup &s);
/// Program coordinates of an absolute position (program units).
EmcPose from_absolute(const Setup &s, const EmcPose &absolute);
void rotate(double *x, double *y, double degrees);
double straight_length(const EmcPose &from, const EmcPose &to);
/// Inverse time: sends the rate for a path of this length.
void inverse_time_rate(Setup &s, double length);
[[nodiscard]] int check_feed(Setup &s, const char *zero_text, const char *no_f_text);
[[nodiscard]] int check_indexers(Setup &s, const EmcPose &end, int g, int *indexer);
void traverse(Setup &s, int line, const EmcPose &end);
void move_indexer(Setup &s, int line, int indexer, const EmcPose &end);
void update_tag(Setup &s);

// ---- codes.cc of state: active codes and tags (active.cc) ----------------------------------------------------------
void active_g(const Setup &s, int *g);
void active_m(const Setup &s, int *m);
void active_values(const Setup &s, double *v);
/// Line of the main program that is under way: the one that is read, or the one that calls.
int main_line(const Setup &s);
void fill_tag(const Setup &s, state_tag_t *tag);
bool modes_of_tag(const state_tag_t &tag, int *g, int *m, double *v);
[[nodiscard]] int execute_inner(Setup &s, const char *text); // context.cc
[[nodiscard]] int restore_after_abort(Setup &s, const state_tag_t &tag);

// ---- comp_moves.cc: straight moves and arcs with compensation ----
[[nodiscard]] int comp_straight(Setup &s, int g, const EmcPose &end);
[[nodiscard]] int comp_arc(Setup &s, int g, const EmcPose &end);

// ---- comp_queue.cc ----
void enqueue_feed_rate(Setup &s, double rate);
void enqueue_feed_mode(Setup &s, int spindle, int mode);
void enqueue_dwell(Setup &s, double seconds);
void enqueue_comment(Setup &s, const char *text);
void enqueue_spindle_mode(Setup &s, int spindle, double css_max);
void enqueue_spindle_speed(Setup &s, int spindle, double speed);
void enqueue_spindle_start(Setup &s, int spindle, CANON_DIRECTION direction);
void enqueue_spindle_stop(Setup &s, int spindle);
void enqueue_orient(Setup &s, int spindle, double degrees, int direction);
void enqueue_wait_orient(Setup &s, int spindle, double timeout);
void enqueue_coolant(Setup &s, bool mist, bool on);
void enqueue_user_m(Setup &s, int num, double p, double q);
void enqueue_m(Setup &s, int m); // M0 M1 M60
/// Sends all that is held back as it stands.
void flush_comp(Setup &s);
/// The pending move ends at the current point, if it can without gouging; then all is sent.
[[nodiscard]] int finish_comp(Setup &s);
void drop_comp(Setup &s);
void scale_comp(Setup &s, double factor);

inline int line_of(const Setup &s) { return s.sequence_number; }

} // namespace ngc

#endif
