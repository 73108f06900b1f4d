# gnuplot friction-update.gp: means of eight samples, the band is the standard error of scheme III (docs/friction-update.md).
set terminal svg size 960,330 font "sans,11" background "white"
set output "friction-update.svg"
set datafile separator ","
set multiplot layout 1,3
set xlabel "axial strain [%]"
set key top left samplen 2
set style fill transparent solid 0.25 noborder
f = "friction-update.csv"
array title[4] = ["I (large steps)", "2(20+5)", "III (small steps)", "large steps, implicit"]
array colour[4] = ["#d62728", "#2ca02c", "#000000", "#1f77b4"]
do for [panel = 0:2] {
    first = 2 + 8 * panel
    if (panel == 0) { set ylabel "volumetric strain [%], compression positive"; set key bottom left; factor = 100 }
    if (panel == 1) { set ylabel "stress ratio"; set key bottom right; factor = 1 }
    if (panel == 2) { set ylabel "mean slip speed / v_R"; set key bottom right; set yrange [0:*]; factor = 1 }
    plot f using (100 * $1):(factor * (column(first + 4) - column(first + 5))):(factor * (column(first + 4) + column(first + 5))) \
             skip 1 with filledcurves lc rgb "#888888" notitle, \
         for [k = 1:4] f using (100 * $1):(factor * column(first + 2 * k - 2)) skip 1 with lines lw 2 lc rgb colour[k] title title[k]
}
unset multiplot
