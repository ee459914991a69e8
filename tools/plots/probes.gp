# Draws probes.csv over time, in hours and degrees Celsius; published values, if given, as circles.
#
#   gnuplot -e "csv='out/pile/probes.csv'; png='probes.png'" tools/plots/probes.gp
#   gnuplot -e "csv='out/pile/probes.csv'; png='probes.png'; published='tools/plots/pile_published.csv'" tools/plots/probes.gp
#
# `published` has the columns hours, degrees Celsius, label.
if (!exists("csv") || !exists("png")) { print "probes.gp: csv and png must be given with -e"; exit status 2 }

set terminal pngcairo size 1000,600 font "DejaVu Sans,13" background "white"
set output png
set datafile separator comma
set key left top reverse Left noenhanced spacing 1.3 samplen 2
set border 3 linewidth 1.2 linecolor "#404040"
set tics nomirror out
set grid linetype 1 linecolor "#dddddd" linewidth 1
set xlabel "time [h]"
set ylabel "temperature [°C]"
set offsets graph 0, graph 0.02, graph 0.05, graph 0
set linetype 1 linecolor "#c23b22" linewidth 2.5
set linetype 2 linecolor "#3d4a8f" linewidth 2.5
set linetype 3 linecolor "#e08a1e" linewidth 2.5
set linetype 4 linecolor "#5b8c5a" linewidth 2.5

set key autotitle columnheader  # the header is no data, here and for stats
stats csv nooutput
columns = STATS_columns
curves = "for [i=2:columns] csv using (column(1)/3600):(column(i)-273.15) with lines linetype i-1"
marks = exists("published") ? ", published using 1:2:3 with labels point pointtype 6 pointsize 1.6 linewidth 2 left offset 1,0 notitle" : ""
eval "plot ".curves.marks
