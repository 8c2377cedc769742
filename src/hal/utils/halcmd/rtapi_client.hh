/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * rtapi_client.hh - asks the realtime process (rtapi_app) over its socket.
 *
 * Thread: [task]. Source: runtime reference, section 7.2 (path and message format).
 */
#ifndef KERF_HALCMD_RTAPI_CLIENT_HH
#define KERF_HALCMD_RTAPI_CLIENT_HH

#include <string>
#include <vector>

namespace halcmd
{

/// Sends a request (rtapi_app's arguments) and waits for the answer (result, text).
/// 0; -ECONNREFUSED: no realtime process; -EPIPE: it went away; -E2BIG: the request is too long.
int rtapi_request(const std::vector<std::string> &args, int &result, std::string &text);

} // namespace halcmd

#endif
