#error "The component 'transport_custom' is not selected: add `components: [+transport_custom]` to microros.yaml and generate again"
