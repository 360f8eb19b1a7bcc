# SPDX-License-Identifier: MIT
# stack.awk - worst stack of the library's functions, from gcc's call graphs.
#
#     awk -f stack.awk *.ci         (-fcallgraph-info=su)
#
# Prints "BYTES FUNCTION" for every function of the interface. What calls through a pointer can reach is
# listed here by the file that calls; another such file, recursion, or a frame of unknown size is an
# error. Jobs are those of the file that has them run. The program's own callbacks (flush, idle, clock, inspect) count
# nothing.
#
# With -v root=reset_handler: of a whole program that was optimized when it was linked, down from that function, its flush included.
BEGIN {
    reach["src/base/jobs.c"] = reach["src/workers/crew.c"] = "_job(\\.|$)"    # what smear_jobs_work is given, by any file
    reach["src/display/row.c"] = "(draws\\.c|sky\\.c|libsmear\\.a@0x[0-9a-f]+):fill(\\.|$)"  # draws.c: a row whose triangles find no room at once; skies
    reach["src/methods/sharp.c"] = reach["src/smooth/smooth.c"] = "sky\\.c:fill(\\.|$)"
    reach["src/frame.c"] = reach["src/accumulate/accumulate.c"] = "sky\\.c:aim(\\.|$)"
    reach["src/smear.c"] = "lights\\.c:begin(\\.|$)"
    reach["src/draws.c"] = "lights\\.c:see(\\.|$)"
    reach["src/geometry/vertex.c"] = "lights\\.c:shade_"
    reach["src/overlay/overlay.c"] = "(^|:)(turned|line)_(find_box|draw_row)(\\.|$)"
    reach["src/methods/temporal.c"] = reach["src/temporal/subframes.h"] = reach["src/temporal/subframes.c"] = "(^|:)fill_tiles(\\.|$)"
    reach["src/geometry/assemble_path.c"] = reach["src/geometry/batch_clip.c"] = "(^|:)place_fine(\\.|$)"
    reach["src/kernels/pixel_rows.c"] = "(^|:)ordered_(555|565)(_swapped)?(\\.|$)"
    reach["src/raster/cover.c"] = "(^|:)rows_|smear_span_(flat|general|level|shadow)(\\.|$)"
    reach["src/raster/raster.h"] = "(^|:)flush_ready(\\.|$)"   # rows_apart.c: between triangles of a row
    if (root != "")
        reach["src/display/band.c"] = "(^|:)flush(\\.|$)"
    is_callback["src/display/row.h"] = is_callback["src/display/band.c"] = is_callback["src/methods/sharp.c"] = is_callback["src/workers/rows_apart.c"] = 1
}
function field(name,    text) {
    if (!match($0, name ": \"[^\"]*\""))
        return ""
    text = substr($0, RSTART, RLENGTH)
    sub(/^[^"]*"/, "", text)
    sub(/"$/, "", text)
    return text
}
/^node:/ {
    title = field("title")
    label = field("label")
    if (match(label, /[0-9]+ bytes \(/)) {
        own[title] = substr(label, RSTART) + 0
        if (label !~ /\(static\)/ && label !~ /\(dynamic,bounded\)/) {
            print "stack.awk: no known size: " title
            bad = 1
        }
    }
}
/^edge:/ {
    from = field("sourcename")
    to = field("targetname")
    if (to == "__indirect_call") {
        split(field("label"), place, ":")
        if ((place[1] in is_callback && !(place[1] in reach)) || (place[1] ~ /^src\/(base\/jobs|workers\/crew)\.c$/ && from != "smear_jobs_work" && root == ""))
            next
        if (!(place[1] in reach)) {
            print "stack.awk: calls through a pointer, to where? " from " (" field("label") ")"
            bad = 1
            next
        }
        to = "@" place[1]
    } else if (root == "" && to ~ /^smear_(jobs|row)_run$/ && from != "smear_row_run") {
        split(field("label"), place, ":")
        to = "%" place[1]
        runs_jobs[place[1]] = 1
    }
    if (!((from, to) in seen)) {
        seen[from, to] = 1
        edge[from] = edge[from] SUBSEP to
    }
}
function depth(f,    callee, count, i, deepest, d) {
    if (f in known)
        return known[f]
    if (busy[f]) {
        print "stack.awk: recursion through " f
        bad = 1
        return 0
    }
    busy[f] = 1
    count = split(edge[f], callee, SUBSEP)
    for (i = 2; i <= count; i++) {
        d = depth(callee[i])
        if (d > deepest)
            deepest = d
    }
    busy[f] = 0
    return known[f] = own[f] + deepest
}
END {
    for (file in runs_jobs) {               # what runs a job, without what it calls beside
        own["%" file] = depth("smear_row_run") > 0 ? depth("smear_row_run") : depth("smear_jobs_run")
        for (f in own)
            if (f ~ ("^" file ":.*_job(\\.|$)"))
                edge["%" file] = edge["%" file] SUBSEP f
    }
    delete known
    for (file in reach)
        for (f in own)
            if (f ~ reach[file])
                edge["@" file] = edge["@" file] SUBSEP f
    for (f in own)
        if (root != "" ? f == root : f ~ /^smear_(memory_size|init|begin|submit|render|filter_begin|filter_row)$/)
            print depth(f), f | "sort -rn"
    # Core 0 alone fills a row's store again, between jobs or in place of them.
    delete known
    edge["@src/display/row.c"] = edge["@src/methods/temporal.c"] = edge["@src/temporal/subframes.h"] = edge["@src/temporal/subframes.c"] = ""
    if (root == "" && "smear_work" in own)
        print depth("smear_work"), "smear_work" | "sort -rn"
    close("sort -rn")
    exit bad
}
