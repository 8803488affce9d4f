// CGAL on a system of half-spaces: exact predicates and exact constructions, the whole polytope and its measure.
//
// Usage: polytope_cgal FILE RUNS. FILE as `cargo bench --bench polytope -- --write` makes it. Prints vertices, facets, the least CPU seconds
// of a polytope alone and of one with its exact measure.
#include <CGAL/Convex_hull_3/dual/halfspace_intersection_3.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polygon_2.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_2.h>
#include <ctime>
#include <fstream>
#include <iostream>
#include <limits>
#include <vector>

using K = CGAL::Exact_predicates_exact_constructions_kernel;
using FT = K::FT;
using Q = FT::ET;
using Z = boost::multiprecision::mpz_int;

static FT number(const Z& integer) { return FT(Q(integer)); }

static double seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

int main(int argc, char** argv) {
    if (argc < 3) return 2;
    std::ifstream file(argv[1]);
    int dimension, count;
    file >> dimension >> count;
    std::vector<FT> o;
    for (int axis = 0; axis < dimension; ++axis) {
        Q coordinate;
        file >> coordinate;
        o.emplace_back(coordinate);
    }
    std::vector<std::vector<Z>> rows(count, std::vector<Z>(dimension + 1));
    for (auto& row : rows)
        for (auto& number : row) file >> number;
    double polytope = std::numeric_limits<double>::infinity(), whole = polytope;
    std::size_t vertices = 0, facets = 0;
    for (int run = 0; run < std::atoi(argv[2]); ++run) {
        const double start = seconds();
        double middle;
        if (dimension == 3) {
            using Mesh = CGAL::Surface_mesh<K::Point_3>;
            std::vector<K::Plane_3> planes;
            for (const auto& r : rows) {
                // CGAL's half-spaces are the points with a x + b y + c z + d <= 0.
                const FT a = number(r[0]), b = number(r[1]), c = number(r[2]), d = number(r[3]);
                planes.emplace_back(-a, -b, -c, -d);
            }
            Mesh mesh;
            CGAL::halfspace_intersection_3(planes.begin(), planes.end(), mesh, K::Point_3(o[0], o[1], o[2]));
            // The coordinates are lazy numbers: what is wanted is the polytope, not a promise.
            for (auto v : mesh.vertices()) mesh.point(v).exact();
            middle = seconds();
            vertices = mesh.number_of_vertices();
            facets = mesh.number_of_faces();
            CGAL::Polygon_mesh_processing::triangulate_faces(mesh);
            CGAL::Polygon_mesh_processing::volume(mesh).exact();
        } else {
            std::vector<K::Point_2> dual, hull;
            for (const auto& r : rows) {
                const FT a = number(r[0]), b = number(r[1]), c = number(r[2]);
                const FT value = a * o[0] + b * o[1] + c;
                dual.emplace_back(-a / value, -b / value);
            }
            CGAL::convex_hull_2(dual.begin(), dual.end(), std::back_inserter(hull));
            CGAL::Polygon_2<K> polygon;
            for (std::size_t i = 0; i < hull.size(); ++i) {
                const auto &p = hull[i], &q = hull[(i + 1) % hull.size()];
                const FT w = p.x() * q.y() - p.y() * q.x();
                polygon.push_back(K::Point_2(o[0] + (q.y() - p.y()) / w, o[1] + (p.x() - q.x()) / w));
            }
            for (auto v = polygon.vertices_begin(); v != polygon.vertices_end(); ++v) v->exact();
            middle = seconds();
            vertices = facets = polygon.size();
            polygon.area().exact();
        }
        polytope = std::min(polytope, middle - start);
        whole = std::min(whole, seconds() - start);
    }
    std::cout << vertices << " " << facets << " " << polytope << " " << whole << "\n";
}
