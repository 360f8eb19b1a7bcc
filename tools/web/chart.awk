# SPDX-License-Identifier: MIT
# chart.awk - from build/chart/chart.csv, as `make chart` writes it, what the page shows: per setting the geometric means
# of cost and error as it comes (linear light, poses of frames ago) over the scenes of the suite in which something
# moves and frames of the demo, as tools/bench/chart_means.c takes them. Other weights and variants have no switch on the
# page.
BEGIN { FS = OFS = ","; print "setting,cost,rmse" }
NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
$column["light"] == "linear" && $column["poses"] == "previous" && $column["group"] ~ /object|camera|demo/ && $column["cost"] > 0 {
    s = $column["setting"]
    if (s ~ /mcguire|guertin|jimenez|spread|plain|half 8 mended/)
        next
    if (!(s in count))
        order[n++] = s
    error = $column["rmse"] > 0.01 ? $column["rmse"] : 0.01
    count[s]++
    cost[s] += log($column["cost"])
    rmse[s] += log(error)
}
END {
    for (i = 0; i < n; i++) {
        s = order[i]
        if (count[s] == count["none"])
            printf "%s,%.3f,%.3f\n", s, exp(cost[s] / count[s]), exp(rmse[s] / count[s])
    }
}
